#!/usr/bin/env python3
"""Trains by 1, 2 and 4 processes and says what more of them would bring: tests/bench/ranks.py [STRIDE]

The model of a batch of PPO: T(N) = C / N + L + B / bandwidth. C, the simulation, is shared by the ranks; L, learning,
is done by the first; B are the bytes that every rank is told. L comes from runs with other numbers of passes over a
batch, so that T(2) is a prediction that the measurement can refute. A core for each rank is assumed.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time

STRIDE = sys.argv[1] if len(sys.argv) > 1 else "build/release/stride"
BATCH, BATCHES = 4096, 24
FEATURES, ACTIONS = 59, 18
BYTES = BATCH * (12 * FEATURES + 8 * ACTIONS + 5)  # states, features, actions, logits, reward and end
SETTINGS = (
    "--baseline --seed 3 --set run.threads=1 --set run.evaluate_every=100000000 --set run.evaluation_episodes=1"
).split()
ENVIRONMENT = dict(
    os.environ,
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_MCA_hwloc_base_binding_policy="none",
    OMPI_MCA_mpi_yield_when_idle="1",
)


def seconds(ranks, preset, decisions, *settings):
    folder = tempfile.mkdtemp()
    command = ["mpirun", "-n", str(ranks), STRIDE, "train", "--preset", preset, *SETTINGS]
    begin = time.time()
    subprocess.run(
        [*command, *settings, "--decisions", str(decisions), "--out", folder + "/run"],
        env=ENVIRONMENT, check=True, capture_output=True,
    )
    duration = time.time() - begin
    shutil.rmtree(folder)
    return duration


def measured(ranks, preset, first, last, *settings):
    return seconds(ranks, preset, last, *settings) - seconds(ranks, preset, first, *settings)


def ppo(ranks, epochs=6):
    return measured(ranks, "ppo", BATCH, BATCH * (BATCHES + 1), "--set", f"ppo.epochs={epochs}") / BATCHES


whole, more = ppo(1), ppo(1, 12)
learning = more - whole  # six passes
simulation = whole - learning
print(f"PPO, a batch of {BATCH} decisions: {whole:.3f} s, of which simulation {simulation:.3f}, learning {learning:.3f}")
print("| ranks | s a batch | by the model |\n|---|---|---|")
print(f"| 1 | {whole:.3f} | |")
for ranks in (2, 4):
    print(f"| {ranks} | {ppo(ranks):.3f} | {simulation / ranks + learning:.3f} |")
for ranks in (16, 128):
    for gigabits in (1, 10):
        exchange = BYTES / (gigabits * 1e9 / 8)
        print(f"| {ranks}, {gigabits} Gbit/s | | {simulation / ranks + learning + exchange:.3f} |")
print("\nDDPG, 12 000 decisions; the first rank learns, the others explore:\n| ranks | s |\n|---|---|")
for ranks in (1, 2, 4):
    print(f"| {ranks} | {measured(ranks, 'demo', 3000, 15000):.2f} |")
