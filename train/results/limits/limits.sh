#!/bin/sh
# What the fastest agent gains where one thing in its model is other: limits.sh RUN [FOLDER [DECISIONS]]. RUN is the
# agent's run folder, from whose networks every arm goes on:
#   stride train --preset ppo --set ppo.lambda=0.95 --potential train/results/human.potential.json --seed 3 --out runs/fast
set -eu
cd "$(dirname "$0")/../../.."
stride=${STRIDE:-build/release/stride} from=$1 runs=${2:-runs/limits} decisions=${3:-120000}
mkdir -p "$runs"

# ARM NAMES TAG FACTOR: the model in which TAG of the muscles or bodies of these NAMES, or of everything if none is
# given, is FACTOR times what it was; then an agent for it.
arm() {
  awk -v names="$2" -v tag="$3" -v factor="$4" '
    /<(Thelen2003Muscle|Body) name=/ { split($0, word, "\""); inside = word[2] ~ "^(" names ")(_[rl])?$" }
    /<\/(Thelen2003Muscle|Body)>/    { inside = 0 }
    index($0, "<" tag ">") && (inside || names == "") {
      split($0, part, /[<>]/)
      printf "%s<%s>%.9g</%s>\n", part[1], tag, part[3] * factor, tag
      next
    }
    { print }' calibrate/models/gait9dof18musc.osim > "$runs/$1.osim"
  [ -e "$runs/$1/config.toml" ] ||
    $stride train --preset ppo --baseline --reference train/results/human.calibrated.csv --from "$from" --seed 21 \
      --decisions "$decisions" --out "$runs/$1" --set environment.model="$runs/$1.osim" --set ppo.alive_per_s=0.3 \
      --set ppo.entropy=0.001 --set ppo.kl=0.006 --set ppo.lambda=0.95 --set run.evaluate_every=40000
}

arm same         ''                max_isometric_force        1
arm strength     ''                max_isometric_force        1.2
arm hamstrings   hamstrings        max_isometric_force        1.2
arm gluteus      glut_max          max_isometric_force        1.2
arm hip-flexors  iliopsoas         max_isometric_force        1.2
arm vasti        vasti             max_isometric_force        1.2
arm calves       'gastroc|soleus'  max_isometric_force        1.2
arm velocity     ''                max_contraction_velocity   1.2
arm deactivation ''                deactivation_time_constant 0.5
arm stiffness    ''                stiffness                  0.25
arm friction     ''                dynamic_friction           1.5
arm torso        torso             mass                       0.8
