#!/bin/sh
# annotate_by_xdotool.sh STRIDE CLIP: answers the two questions, clicks three parts, draws a calibration line, zooms by the
# wheel, says x on the last frame by the timeline and where playback stops, and quits, as a person would.
# Ends with 77 where Xvfb or xdotool is missing.
set -eu
command -v Xvfb >/dev/null && command -v xdotool >/dev/null || { echo "no Xvfb or no xdotool"; exit 77; }
folder=$(dirname "$2")
mkfifo "$folder/display"
Xvfb -displayfd 3 -screen 0 1400x900x24 3>"$folder/display" >/dev/null 2>&1 &
xvfb=$!
trap 'kill $xvfb 2>/dev/null || true' EXIT
read -r number <"$folder/display"
export DISPLAY=":$number"
unset QT_QPA_PLATFORM WAYLAND_DISPLAY || true
timeout 60 "$1" annotate "$2" &
stride=$!
window=$(timeout 40 xdotool search --sync --onlyvisible --name 'stride annotate' | head -n 1)
sleep 1
xdotool windowfocus "$window"
xdotool key r; sleep 0.3
xdotool key Return; sleep 0.3
xdotool mousemove 640 300; sleep 0.2; xdotool click 1; sleep 0.3
xdotool mousemove 650 380; sleep 0.2; xdotool click 3; sleep 0.3
xdotool key x; sleep 0.3
xdotool key apostrophe; sleep 0.3
xdotool mousemove 300 150; sleep 0.2; xdotool click 1; sleep 0.3
xdotool mousemove 300 450; sleep 0.2; xdotool click 1; sleep 0.3
xdotool type --delay 50 2.5; sleep 0.3; xdotool key Return; sleep 0.3
xdotool mousemove 640 300; sleep 0.2; xdotool click 4; sleep 0.5
xdotool mousemove 1262 720; sleep 0.2; xdotool click 1; sleep 0.3
xdotool key x; sleep 0.3
xdotool key Home; sleep 0.3; xdotool key Tab; sleep 0.7; xdotool key Tab; sleep 0.3; xdotool key x; sleep 0.3
xdotool key q
wait $stride
