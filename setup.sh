#!/bin/sh
# Installs the Debian 12 packages that Stride is built from, and nothing else.
set -eu

packages="
  g++ cmake ninja-build pkg-config ca-certificates git
  libopencv-dev libavformat-dev libeigen3-dev libceres-dev libsimbody-dev
  libpugixml-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev libfmt-dev libssl-dev libboost-dev
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
  gnuplot-nox clang-format
"

missing=""
for package in $packages; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
[ -z "$missing" ] && { echo "setup: every package is installed"; exit 0; }

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: run as root, or install sudo; missing:$missing" >&2; exit 1; }
  as_root="sudo"
fi
$as_root apt-get update
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
