# Doxygen's input filter: the plain comments of a header as Doxygen reads them, line by line.
#
#   // text         before a declaration    its documentation; before a blank line or a namespace: that of the file
#   code  // text   behind a member         its documentation; lines below with // in the same column go on
#   //   name: text                         a list, where all of an indented run looks like that; else as it stands
#   // Errors: ...                          a paragraph, as are the other words of `paragraphs`
#   double a, b;  // text                   documentation of both
#
# Comments inside functions, and headings (// ---- Text ----), stay plain.

function spaces_before(text) {
    match(text, /^ */)
    return RLENGTH
}

# What Doxygen and Markdown would take for something else; `x` becomes code.
function escaped(text,    parts, n, i, result) {
    gsub(/\\/, "\\\\", text)
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    gsub(/[#%@*]/, "\\\\&", text)
    gsub(/--/, "\\--", text)
    n = split(text, parts, "`")
    result = parts[1]
    for (i = 2; i <= n; ++i) result = result (i % 2 == 0 ? (i < n ? "<tt>" : "`") : "</tt>") parts[i]
    return result
}

function is_item(text) { return text ~ /^ +[A-Za-z_][A-Za-z0-9_.]*(, [A-Za-z_][A-Za-z0-9_.]*)*: / }

# The end of the indented run that begins at line i of the block, and in `run_is_list` what it is.
function end_of_run(i,    first, j) {
    first = spaces_before(block[i])
    run_is_list = 1
    for (j = i; j <= lines && block[j] ~ /^   /; ++j)
        if (spaces_before(block[j]) < first || (spaces_before(block[j]) == first && !is_item(block[j]))) run_is_list = 0
    return j - 1
}

# Writes the block of comments with `open` before its text.
function write_block(open,    i, j, last, text, start, colon) {
    for (i = 1; i <= lines; ++i) out[i] = ""
    for (i = 1; i <= lines; i = last + 1) {
        last = i
        if (block[i] !~ /^   /) {
            # Not an empty line, after which Doxygen 1.9.4 takes verbatim text for prose.
            text = block[i] == "" ? "<p>" : escaped(substr(block[i], 2))
            if (match(text, paragraphs)) text = "<p><b>" substr(text, 1, RLENGTH) "</b>" substr(text, RLENGTH + 1)
            out[i] = text
            continue
        }
        last = end_of_run(i)
        if (run_is_list) {
            for (j = i; j <= last; ++j) {
                start = spaces_before(block[j])
                text = substr(block[j], start + 1)
                if (start == spaces_before(block[i])) {
                    colon = index(text, ": ")
                    text = "- <b>" escaped(substr(text, 1, colon - 1)) "</b>: " escaped(substr(text, colon + 2))
                } else {
                    text = "  " escaped(text)
                }
                out[j] = text
            }
        } else {
            for (j = i; j <= last; ++j) out[j] = substr(block[j], 2)
            if (i > 1) out[i - 1] = out[i - 1] " \\verbatim"
            else out[i] = "\\verbatim\n" out[i]
            out[last] = out[last] " \\endverbatim"
        }
    }
    for (i = 1; i <= lines; ++i) print (i == 1 ? "/** " open : "") out[i] (i == lines ? " */" : "")
    lines = 0
}

function write_plain(    i) {
    for (i = 1; i <= lines; ++i) print "//" block[i]
    lines = 0
}

# All of the block as one line.
function joined(    i, text) {
    text = ""
    for (i = 1; i <= lines; ++i) text = text (i > 1 ? " " : "") escaped(substr(block[i], 2))
    return text
}

function scope() { return types > 0 ? type_indent[types] + 4 : 0 }

# A declaration of several members, each with the documentation: of the lines before, and behind it.
function split_members(code, documentation,    n, parts, i, type, result) {
    n = split(substr(code, 1, length(code) - 1), parts, ", ")
    type = parts[1]
    sub(/ = .*/, "", type)
    sub(/[^ ]*$/, "", type)
    result = parts[1] "; /**< " documentation " */"
    for (i = 2; i <= n; ++i) result = result " " type parts[i] "; /**< " documentation " */"
    return result
}

# Markdown: the page has a name, since Doxygen cannot refer to a path with a blank; links that lead to no page become
# text.
FILENAME ~ /\.md$/ {
    if (FNR == 1 && FILENAME ~ /migration\.md$/) $0 = $0 " {#migration}"
    gsub(/\]\(examples\/migration\.md\)/, "](@ref migration)")
    while (match($0, /\]\(tests[^)]*\)/)) {
        rest = substr($0, RSTART + RLENGTH)
        $0 = substr($0, 1, RSTART - 1)
        match($0, /.*\[/)
        $0 = substr($0, 1, RLENGTH - 1) substr($0, RLENGTH + 1) rest
    }
    print
    next
}

BEGIN { paragraphs = "^(Errors|Accuracy|Sources?|Cost|Memory|Scratch|Bound of [^:]*):" }

FNR == 1 {
    file = FILENAME
    sub(/^.*\/include\//, "", file)
    folder = file
    sub(/^bumpshadow\//, "", folder)
    if (!sub(/\/.*/, "", folder)) folder = "surface"
    lines = types = in_body = behind = 0
    if (file ~ /\.h$/) printf "/** \\open{%s} */ ", folder
}

in_body {
    if (substr($0, 1, scope() + 1) == sprintf("%" scope() "s}", "")) in_body = 0
    print
    next
}

# Goes on with the comment behind the member above.
behind && index($0, "//") == behind && $0 ~ /^ *\/\/ / {
    print substr($0, 1, behind - 1) "///< " escaped(substr($0, behind + 3))
    next
}

{ behind = 0 }

/^ *\/\/ ----/ { write_plain(); print; next }

/^ *\/\/( |$)/ {
    if (lines == 0) block_indent = spaces_before($0)
    block[++lines] = substr($0, index($0, "//") + 2)
    next
}

lines > 0 && block_indent == 0 && /^(namespace .*)?$/ { write_block("\\file " file " ") }
lines > 0 && /^$/ { write_plain() }

# So that all files have a page.
/^#pragma once$/ { print "/// \\file " file; next }

/^namespace [a-z_:]* \{$/ {
    print $0 ($2 ~ /_detail$/ ? "" : "  /** \\open{" folder "} */")
    next
}
/^}  \/\/ namespace / {
    write_plain()
    print ($NF ~ /_detail$/ ? "" : "/** @} */ ") $0
    next
}

types > 0 && spaces_before($0) == type_indent[types] && /^ *}/ { --types }

{
    code = $0
    text = ""
    if (match(code, /  +\/\/ /) && code !~ /"[^"]*\/\/[^"]*"/) {
        text = escaped(substr(code, RSTART + RLENGTH))
        behind = RSTART + RLENGTH - 3
        code = substr(code, 1, RSTART - 1)
    }
    if (types > 0 && code ~ /^[^(<{]*[a-z_\]0-9f], [a-z_]+.*;$/ && (text != "" || lines > 0)) {
        text = joined() (lines > 0 && text != "" ? " " : "") text
        write_plain()
        print split_members(code, text)
        behind = 0
        next
    }
    if (lines > 0) write_block("")
    print code (text != "" ? "  ///< " text : "")
}

/^ *(struct|class|enum|enum class|union) .*\{$/ { type_indent[++types] = spaces_before($0); next }
/^#/ { next }
/\{$/ { in_body = 1 }

END {
    write_plain()
    if (file ~ /\.h$/) print "/** @} */"
}
