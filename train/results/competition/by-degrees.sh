#!/bin/sh
# The chain by degrees of report.md, before backward knees cost, about 7 million decisions: by-degrees.sh [FOLDER [SEED]]. Given again
# it continues where it stopped.
set -eu
cd "$(dirname "$0")/../../.."
stride=build/release/stride runs=${1:-runs/competition} seed=${2:-11}
mkdir -p "$runs"
reference=$runs/fast.calibrated.csv
[ -e "$reference" ] || $stride evaluate train/agents/stride --no-film --out "$runs" --trajectory "$reference"

. train/results/competition/stage.sh

# Few obstacles, half of the environments start on the fast agent's run.
rules="--preset ppo --set ppo.lambda=0.95 --set reward.backward_knees=0 --set environment.rules=nips2017 --set environment.difficulty=2
  --set environment.max_obstacles=10 --set observation.robust=true --set run.evaluate_every=200000
  --set run.evaluation_episodes=4"
mostly_flat="--set environment.flat_share=0.8 --set environment.few_share=0.1"
stage s1 2500000 $rules $mostly_flat --set environment.drop_contacts=false \
  --set ppo.decay_decisions=5000000 --set ppo.final_kl=0.01
later="--set ppo.alive_per_s=0.5 --set ppo.kl=0.02"
half="$later --set ppo.alive_decisions=500000 --set ppo.final_kl=0.015 --set ppo.decay_decisions=1500000"
stage s2 1134592 $rules $mostly_flat $half --set environment.drop_share=0.5
stage s3 700000 $rules $mostly_flat $half --set environment.drop_share=0.8
n=1
for share in 0.95 0.985 0.995 0.9985; do
  stage d$n 200000 $rules $later --set environment.flat_share=0.7 --set environment.few_share=0.2 \
    --set ppo.alive_decisions=1000000 --set ppo.final_kl=0.012 --set ppo.decay_decisions=3000000 \
    --set environment.drop_share=$share
  n=$((n + 1))
done
stage o1 "${DECISIONS:-2000896}" --preset competition --set reward.backward_knees=0
