"""Steps of StrideVectorEnv against those of `stride bench`: n = 64 in two threads, random actions held for ten steps,
in pairs; and one StrideEnv.

    PYTHONPATH=build/release/python python3 tests/bench/vector_env.py build/release/stride
"""

import json
import statistics
import subprocess
import sys
import time

import numpy
import stride

PAIRS, N, THREADS, STEPS = 5, 64, 2, 1500


def vector_steps_per_s():
    env = stride.StrideVectorEnv(n=N, threads=THREADS)
    random = numpy.random.default_rng(1)
    env.reset(seed=1)
    start = time.perf_counter()
    for step in range(STEPS):
        if step % 10 == 0:
            actions = random.uniform(0, 1, (N, 18))
        env.step(actions)
    return N * STEPS / (time.perf_counter() - start)


def single_steps_per_s():
    env = stride.StrideEnv()
    random = numpy.random.default_rng(1)
    env.reset(seed=1)
    start = time.perf_counter()
    for step in range(STEPS * 20):
        if step % 10 == 0:
            action = random.uniform(0, 1, 18)
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()
    return STEPS * 20 / (time.perf_counter() - start)


def bench_steps_per_s(program):
    command = [program, "bench", "--engine", "planar", "--workload", "random", "--threads", str(THREADS), "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["steps_per_s"]


if len(sys.argv) != 2:
    sys.exit(__doc__)
print("| n = 64, two threads, steps/s of wall clock | stride bench --threads 2 | share | one environment |\n|---|---|---|---|")
shares = []
for _ in range(PAIRS):
    many = vector_steps_per_s()
    bench = bench_steps_per_s(sys.argv[1])
    shares.append(many / bench)
    print(f"| {many:.0f} | {bench:.0f} | {shares[-1]:.3f} | {single_steps_per_s():.0f} |", flush=True)
print(f"\nMedian share {statistics.median(shares):.3f}")
