#!/bin/sh
# Kills a training at random moments, resumes it each time, and compares its curve and its agents with those of the
# same training left alone, byte by byte. Minutes; the short version is the test Train.KilledAnywhere….
#     tests/train/kill_and_resume.sh build/release/stride [KILLS [SEED]]
set -eu
stride=$1 kills=${2:-50} seed=${3:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
decisions=$((kills * 2500))

train() {  # FOLDER: begins it, or goes on
  if [ -e "$1/config.toml" ]; then
    exec "$stride" train --resume "$1"
  fi
  exec "$stride" train --preset ddpg --baseline --seed "$seed" --out "$1" --decisions $decisions \
      --set run.warm_up=2000 --set run.evaluate_every=2000 --set run.checkpoint_s=0.2 --set replay.capacity=20000
}

start=$(date +%s)
(train "$folder/alone") > "$folder/log" 2>&1
echo "$decisions decisions, left alone: $(($(date +%s) - start)) s"

hit=0
while [ "$hit" -lt "$kills" ]; do
  (train "$folder/killed") > "$folder/log" 2>&1 &
  child=$!
  sleep "$(awk -v seed="$seed$hit" 'BEGIN { srand(seed); printf "%.3f", 0.05 + 2 * rand() }')"
  kill -KILL $child 2> /dev/null || break  # it has finished
  wait $child 2> /dev/null || hit=$((hit + 1))
done
(train "$folder/killed") > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
for file in curve.csv agent.safetensors best.safetensors; do
  cmp "$folder/alone/$file" "$folder/killed/$file"
done
if ls "$folder/killed" "$folder/killed/replay" | grep '\.tmp'; then exit 1; fi
echo "killed $hit times: curve.csv, agent.safetensors and best.safetensors are the same, byte by byte"
