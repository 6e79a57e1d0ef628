#!/bin/sh
# The agent of report.md from nothing, about ten million decisions: chain.sh [FOLDER [SEED]]. Given again it continues
# where it stopped.
set -eu
cd "$(dirname "$0")/../../.."
stride=${STRIDE:-build/release/stride} runs=${1:-runs/competition} seed=${2:-11}

# NAME DECISIONS OPTION…: one stage.
stage() {
  run=$runs/$1 decisions=$2
  shift 2
  if [ -e "$run/config.toml" ]; then
    $stride train --resume "$run" --decisions "$decisions"
  else
    $stride train --baseline --reference train/results/human.calibrated.csv --seed "$seed" --decisions "$decisions" \
      --out "$run" "$@"
  fi
}

# The rules with all their oddities: mostly on flat ground, among some obstacles, among many.
stage flat 1208320 --preset ppo --set environment.rules=nips2017 --set environment.difficulty=2 \
  --set environment.max_obstacles=10 --set observation.robust=true --set environment.flat_share=0.8 \
  --set environment.few_share=0.1 --set run.evaluate_every=200000 --set run.evaluation_episodes=4
stage some 2603008 --preset competition --from "$runs/flat"
stage many 6000000 --preset competition --from "$runs/some" --set environment.flat_share=0.1 \
  --set environment.few_share=0.2 --set run.evaluation_episodes=20 --set ppo.alive_decisions=100000 \
  --set ppo.decay_decisions=3000000
