# awk -f directions.awk allowed.txt EDGES: prints the edges ("FROM TO") that are not allowed.
function group_of(path, i) {
    for (i = 1; i <= patterns; ++i)
        if (path ~ pattern[i]) return group[i]
}
# The method of a folder that a header is, or is a part of.
function method_of(path, folder, name, list, count, i) {
    folder = path
    if (!sub(/\/[^\/]*$/, "", folder) || !(folder in methods)) return ""
    name = substr(path, length(folder) + 2)
    sub(/\.hpp$/, "", name)
    count = split(methods[folder], list, " ")
    for (i = 1; i <= count; ++i)
        if (name == list[i] || index(name, list[i] "_") == 1) return folder "/" list[i]
    return ""
}
/^#/ || NF == 0 { next }
$1 == "group" {
    for (i = 4; i <= NF; ++i) {
        regex = $i
        gsub(/\./, "\\.", regex)
        gsub(/\*/, ".*", regex)
        pattern[++patterns] = "^" regex "$"
        group[patterns] = $2
    }
    next
}
$1 == "methods" {
    for (i = 4; i <= NF; ++i) methods[$2] = methods[$2] " " $i
    next
}
$2 == "->" {
    for (i = 3; i <= NF; ++i) allowed[$1, $i] = 1
    next
}
{
    from = group_of($1)
    to = group_of($2)
    if (from != to && !((from, to) in allowed)) print $1 " includes " $2 ": " from " may not include " to
    from_method = method_of($1)
    to_method = method_of($2)
    if (from == to && to_method != "" && from_method != to_method)
        print $1 " includes " $2 ", which belongs to the method " to_method
}
