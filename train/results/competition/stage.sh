# For chain.sh and by-degrees.sh, which set stride, runs, seed and reference.

from=
# NAME DECISIONS OPTION…: one stage, from the networks of the one before; given again it continues where it stopped.
stage() {
  run=$runs/$1 decisions=$2
  shift 2
  if [ -e "$run/config.toml" ]; then
    $stride train --resume "$run" --decisions "$decisions"
  else
    $stride train --baseline --reference "$reference" ${from:+--from "$from"} --seed "$seed" \
      --decisions "$decisions" --out "$run" "$@"
  fi
  from=$run
}
