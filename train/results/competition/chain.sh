#!/bin/sh
# The agent of report.md from nothing, about twelve million decisions: chain.sh [FOLDER [SEED [DECISIONS OF many]]].
# Given again it continues where it stopped.
set -eu
cd "$(dirname "$0")/../../.."
stride=${STRIDE:-build/release/stride} runs=${1:-runs/competition} seed=${2:-11} many=${3:-6000000}

reference=train/results/human.calibrated.csv
. train/results/competition/stage.sh

# The rules with all their oddities: mostly on flat ground, among some obstacles, among many.
stage flat 1208320 --preset ppo --set ppo.lambda=0.95 --set environment.rules=nips2017 --set environment.difficulty=2 \
  --set environment.max_obstacles=10 --set observation.robust=true --set environment.flat_share=0.8 \
  --set environment.few_share=0.1 --set run.evaluate_every=200000 --set run.evaluation_episodes=4
stage some 2603008 --preset competition
stage many "$many" --preset competition --set environment.flat_share=0.1 \
  --set environment.few_share=0.2 --set run.evaluation_episodes=20 --set ppo.alive_decisions=100000 \
  --set ppo.decay_decisions=3000000

# The same among still more obstacles, by larger batches and smaller steps; chosen on a hundred scenes.
stage steady 2000000 --preset competition --set environment.flat_share=0.1 \
  --set environment.few_share=0.1 --set run.evaluation_episodes=100 --set ppo.horizon=64 --set ppo.minibatch=512 \
  --set ppo.alive_per_s=0.3 --set ppo.kl=0.008 --set ppo.final_kl=0.003 --set ppo.entropy=0.001 \
  --set ppo.final_entropy=0.0005 --set ppo.decay_decisions=2000000
