#include "demo/page.hpp"

#include <cstddef>
#include <string_view>

#include "common/report_text.hpp"

namespace examples {
namespace {

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>bumpshadow: bumps that cast shadows</title>
<style>
body { margin: 0 auto; padding: 1.5rem; max-width: 66rem; }
body { background: #17181a; color: #dedcd6; font: 1rem/1.5 sans-serif; }
h1 { font-weight: 600; margin: 0 0 .25rem; }
h2 { font-weight: 600; font-size: 1.15rem; margin: 2.5rem 0 .5rem; }
p { margin: .25rem 0; }
figure { margin: 1rem 0; }
figcaption { color: #a9a69e; font-size: .9rem; margin-top: .3rem; }
img { display: block; max-width: 100%; height: auto; border-radius: 3px; }
.magnified img { width: 100%; image-rendering: pixelated; }
.controls { display: flex; gap: 1rem; align-items: center; margin: .5rem 0; max-width: 32rem; }
.controls input { flex: 1; }
</style>
</head>
)";

// The frames are plain files; without a script the first one stands still and the sheet below shows them all.
constexpr std::string_view script = R"js(<script>
const frames = [...document.querySelectorAll("#frames img")].map(image => image.src);
const picture = document.getElementById("turning"), slider = document.getElementById("bearing");
const button = document.getElementById("play"), text = document.getElementById("which");
let timer = null;
function show() {
    picture.src = frames[slider.value];
    text.textContent = "bearing " + (slider.value / frames.length).toFixed(4);
}
function play(on) {
    clearInterval(timer);
    timer = on ? setInterval(() => { slider.value = (+slider.value + 1) % frames.length; show(); }, 140) : null;
    button.textContent = on ? "stop" : "turn";
}
slider.oninput = () => { play(false); show(); };
button.onclick = () => play(timer === null);
show();
play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
</script>
)js";

std::string figure(const std::string& file, std::string_view caption) {
    return "<figure><img src=\"" + file + "\" alt=\"" + escaped(caption) + "\"><figcaption>" + escaped(caption) +
           "</figcaption></figure>\n";
}

}  // namespace

std::string make_page(const page_facts& facts) {
    std::string page(head);
    page += facts.magnified ? "<body class=\"magnified\">\n" : "<body>\n";
    page += "<h1>Bumps that cast shadows</h1>\n<p>" + escaped(facts.map) + "</p>\n<p>" + escaped(facts.bake) +
            "</p>\n<p>" + escaped(facts.error) + "</p>\n";
    page += figure(facts.side_by_side,
                   "Left half: plain normal mapping. Right half: the same light with shadows from the horizon map.");

    page += "<h2>Three elevations of the light</h2>\n";
    for (std::size_t i = 0; i < facts.stills.size(); ++i) page += figure(facts.stills[i], facts.still_captions[i]);

    page +=
        "<h2>The light turns</h2>\n<figure><img id=\"turning\" src=\"" + facts.frames.front() +
        "\" alt=\"The surface under a light that turns\">\n<div class=\"controls\"><button id=\"play\">turn</button>"
        "<input id=\"bearing\" type=\"range\" min=\"0\" max=\"" +
        std::to_string(facts.frames.size() - 1) +
        "\" value=\"0\" aria-label=\"bearing of the light\"><span id=\"which\"></span></div>\n"
        "<figcaption>Bearing 0: light from the right; 0.25: from below; 0.5: from the left; 0.75: from above."
        "</figcaption></figure>\n<div id=\"frames\" hidden>";
    for (const std::string& frame : facts.frames) page += "<img src=\"" + frame + "\" alt=\"\">";
    page += "</div>\n";
    page += figure(facts.contact_sheet, "All " + std::to_string(facts.frames.size()) +
                                            " bearings, row by row, starting with light from the right.");

    page += "<h2>What it is made from</h2>\n";
    page += figure(facts.heights, "The height map, lowest texel black, highest white.");
    page += figure(facts.slices,
                   "The horizon map: for each of 16 bearings how high the horizon stands, 0 degrees black, 90 white. "
                   "Row by row, starting with the horizon to the right.");
    page += script;
    page += "</body>\n</html>\n";
    return page;
}

}  // namespace examples
