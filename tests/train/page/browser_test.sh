#!/bin/sh
# The pages of a clip, a run and an experiment, as a browser shows them on a phone, on a screen and in print: nothing is
# loaded from elsewhere, nothing is wider than the window, every picture and film is there, and no script is needed.
#     tests/train/page/browser_test.sh build/release/stride chromium SOURCE FOLDER
set -eu
stride=$1 chromium=$2 source=$3 folder=$4
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
browser() {
  timeout 120 "$chromium" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars \
    --autoplay-policy=no-user-gesture-required --user-data-dir="$folder/profile" "$@" 2> browser.log
}

cp "$source/videos/human.mp4" "$source/videos/human.keypoints.json" .
"$stride" track human.mp4 -o human.trajectory.csv > log
"$stride" calibrate human.trajectory.csv > log
"$stride" report human.trajectory.csv --video human.mp4 -o clip.html > log
"$stride" report "$source/train/agents/stride" -o run.html > log
"$stride" report "$source/train/results/ways" -o experiment.html > log

# What the page itself cannot know: a copy of it tells by its title.
probe='<script>addEventListener("load", () => setTimeout(() => {
  const here = document.documentElement, pictures = [...document.images], films = [...document.querySelectorAll("video")];
  document.title = ["wider by", here.scrollWidth - innerWidth, "loaded", performance.getEntriesByType("resource")
    .filter(r => !r.name.startsWith("data:")).length, "missing", pictures.filter(p => p.naturalWidth == 0).length +
    films.filter(f => f.readyState < 1).length, "pictures", pictures.length > 0].join(" ");
}, 1500));</script>'
for page in clip run experiment; do
  if grep -qi "<script\|https\?://[^\"]*\.\(js\|css\|png\|jpg\)" $page.html; then echo "$page needs more than itself"; exit 1; fi
  { cat $page.html; echo "$probe"; } > probe.html
  for width in 390 1280; do
    title=$(browser --window-size=$width,900 --virtual-time-budget=8000 --dump-dom "file://$folder/probe.html" |
            sed -n 's/.*<title>\(.*\)<\/title>.*/\1/p' | head -n 1)
    [ "$title" = "wider by 0 loaded 0 missing 0 pictures true" ] || { echo "$page at $width px: $title"; cat browser.log; exit 1; }
  done
  browser --print-to-pdf=$page.pdf "file://$folder/$page.html" > log
  [ "$(head -c 5 $page.pdf)" = "%PDF-" ]
done
echo "three pages at two widths and in print"
