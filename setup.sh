#!/bin/sh
# Installs the Debian 12 packages that Stride is built from. With --pose also the network that finds a runner's joints
# without clicks: BlazePose (Google, Apache 2.0) from the npm package @mediapipe/pose, 31 MB, checked by its hashes.
set -eu

with_pose=""
for option in "$@"; do
  case $option in
    --pose) with_pose=yes ;;
    *) echo "setup: $option: no such option; usage: ./setup.sh [--pose]" >&2; exit 2 ;;
  esac
done

packages="
  g++ cmake ninja-build pkg-config ca-certificates git
  libopencv-dev qtbase5-dev libavformat-dev libeigen3-dev libceres-dev libsimbody-dev
  libpugixml-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev libfmt-dev libssl-dev libboost-dev
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
  gnuplot-nox clang-format xvfb xdotool
  python3-dev python3-numpy pybind11-dev
  libopenmpi-dev openmpi-bin
"

[ -z "$with_pose" ] || command -v npm >/dev/null || packages="$packages npm"

missing=""
for package in $packages; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
if [ -z "$missing" ]; then
  echo "setup: every package is installed"
else
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "setup: run as root, or install sudo; missing:$missing" >&2; exit 1; }
    as_root="sudo"
  fi
  $as_root apt-get update
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
fi
[ -n "$with_pose" ] || exit 0

# Where stride looks for it, installed or not (extract/pose/README.md).
place=${XDG_DATA_HOME:-$HOME/.local/share}/stride/pose
package=@mediapipe/pose@0.5.1675469404
archive_sha256=8bb349a7b3a3ba699df23be804ddd3b3eab810b50b15406894be257859388a84
landmarks_sha256=59e42d71bcd44cbdbabc419f0ff76686595fd265419566bd4009ef703ea8e1fe
detector_sha256=a63c614bef30d35947f13be361820b1e4e3bec9cfeebf4d11216a18373108e85

# check FILE SHA256
check() {
  echo "$2  $1" | sha256sum --check --status 2>/dev/null
}
landmarks=$place/pose_landmark_heavy.tflite
detector=$place/pose_detection.tflite
if check "$landmarks" $landmarks_sha256 && check "$detector" $detector_sha256; then
  echo "setup: the pose network is in $place"
  exit 0
fi

# must_be FILE SHA256
must_be() {
  check "$1" "$2" || { echo "setup: ${1##*/} of $package is not the file that Stride knows (sha256 $(sha256sum <"$1"), must be $2)" >&2; exit 1; }
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && npm pack --silent $package >/dev/null) || { echo "setup: npm could not fetch $package; is there a network?" >&2; exit 1; }
must_be "$work"/mediapipe-pose-*.tgz $archive_sha256
tar xzf "$work"/mediapipe-pose-*.tgz -C "$work" package/pose_landmark_heavy.tflite package/pose_solution_packed_assets.data
must_be "$work/package/pose_landmark_heavy.tflite" $landmarks_sha256
must_be "$work/package/pose_solution_packed_assets.data" $detector_sha256
mkdir -p "$place"
cp /usr/share/common-licenses/Apache-2.0 "$place/LICENSE"
cat >"$place/README" <<END
BlazePose (V. Bazarevsky, I. Grishchenko, K. Raveendran, T. Zhu, F. Zhang, M. Grundmann: BlazePose: On-device Real-time Body
Pose tracking, 2020), by Google, Apache License 2.0 (LICENSE), unchanged, from the npm package $package:
pose_landmark_heavy.tflite, and pose_detection.tflite, which is called pose_solution_packed_assets.data there.
END
install -m 644 "$work/package/pose_solution_packed_assets.data" "$detector"
install -m 644 "$work/package/pose_landmark_heavy.tflite" "$landmarks"
echo "setup: the pose network is in $place"
