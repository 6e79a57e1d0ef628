#!/bin/sh
# One training by 1, 2 and 4 ranks gives the same bytes; a rank that is killed ends the others, and --resume, by
# another number of ranks, gives the bytes of the run left alone. Clips and an experiment's runs are shared as well.
#     tests/train/parallel/ranks_test.sh build/release/stride mpirun SOURCE FOLDER
set -eu
stride=$1 mpirun=$2 source=$3 folder=$4
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
ranks() { n=$1; shift; "$mpirun" -n "$n" "$stride" "$@"; }

settings="--preset ddpg --baseline --seed 3 --set run.threads=1 run.warm_up=300 run.evaluate_every=500
          run.environments=6 exploration.parameter_share=0.5 agent.actor_hidden=[16] agent.critic_hidden=[16]"
for n in 1 2 4; do
  # shellcheck disable=SC2086
  ranks $n train $settings --decisions 1500 --out "by$n" > "log$n" 2>&1 || { cat "log$n"; exit 1; }
done
for n in 2 4; do
  for file in curve.csv agent.safetensors best.safetensors config.toml; do cmp by1/$file by$n/$file; done
done

# The same with the other learner.
ppo="--preset ppo --baseline --seed 3 --set run.threads=1 run.evaluate_every=600 run.evaluation_episodes=2
     run.environments=20 ppo.horizon=15 ppo.minibatch=100 ppo.actor_hidden=[16] ppo.critic_hidden=[16]"
for n in 1 2 4; do
  # shellcheck disable=SC2086
  ranks $n train $ppo --decisions 1500 --out "ppo$n" > "ppo-log$n" 2>&1 || { cat "ppo-log$n"; exit 1; }
done
# shellcheck disable=SC2086
ranks 2 train $ppo --decisions 700 --out ppo3 > ppo-log3 2>&1 || { cat ppo-log3; exit 1; }
ranks 3 train --resume ppo3 --decisions 1500 > ppo-log3 2>&1 || { cat ppo-log3; exit 1; }
for n in 2 3 4; do
  for file in curve.csv agent.safetensors; do cmp ppo1/$file ppo$n/$file; done
done

# A rank dies: mpirun says so and ends the others; the run goes on from its checkpoint.
# shellcheck disable=SC2086
ranks 2 train $settings --decisions 1500 --set run.checkpoint_s=0.05 --out killed > killed.log 2>&1 &
job=$!
for _ in $(seq 600); do [ -e killed/checkpoint.safetensors ] && break; sleep 0.05; done
victim=$(pgrep -P "$(pgrep -P $job -f mpirun || echo $job)" | tail -n 1)
kill -KILL "$victim" 2> /dev/null || true
if wait $job; then killed=no; else killed=yes; fi  # a fast machine may have finished before
[ $killed = no ] || grep -q "exited on signal 9" killed.log || { cat killed.log; exit 1; }
ranks 3 train --resume killed > resumed.log 2>&1 || { cat resumed.log; exit 1; }
for file in curve.csv agent.safetensors; do cmp by1/$file killed/$file; done

# The runs of an experiment, shared by ranks, and as jobs of an array with a merge.
cat > two.toml << 'EOF'
title = "Two arms"
preset = "ddpg"
decisions = 600
seeds = 2

[one]
potential = ""
agent.actor_hidden = [8]
agent.critic_hidden = [8]

[two]
potential = ""
agent.actor_hidden = [16]
agent.critic_hidden = [8]
EOF
common="--set run.warm_up=200 run.evaluate_every=200"
# shellcheck disable=SC2086
ranks 2 experiment two.toml $common --jobs 1 --out shared > shared.log 2>&1 || { cat shared.log; exit 1; }
[ "$("$stride" experiment two.toml --list | tr '\n' ' ')" = "one/1 two/1 one/2 two/2 " ]
for run in $("$stride" experiment two.toml --list); do
  # shellcheck disable=SC2086
  "$stride" experiment two.toml $common --out array --only "$run" > array.log 2>&1 || { cat array.log; exit 1; }
  [ ! -e array/report ]
  [ "$run" = one/2 ] || continue
  # Half of it is there: the seed that both arms have is reported, the other one is named.
  # shellcheck disable=SC2086
  "$stride" experiment two.toml $common --out array --report half --merge > half.log 2>&1
  grep -q "two/2: is not finished; seed 2 is left out" half.log
done
# shellcheck disable=SC2086
"$stride" experiment two.toml $common --out array --merge > merge.log 2>&1
for run in one/1 one/2 two/1 two/2; do cmp shared/$run/curve.csv array/$run/curve.csv; done
if "$stride" experiment two.toml --only three/1 2> wrong.log; then exit 1; fi
grep -q "must be one of one/1, two/1, one/2, two/2" wrong.log
bash -n "$source/train/commands/experiment.slurm"
echo "by 1, 2 and 4 ranks, after a kill, and as an array: the same bytes"
