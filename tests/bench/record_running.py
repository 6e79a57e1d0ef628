"""Writes train/agents/stride/running.csv, the workload `running` of `stride bench`: three seconds of the agent
that ships, from the second second on.

    PYTHONPATH=build/release/python python3 tests/bench/record_running.py > train/agents/stride/running.csv
"""

import stride

folder = stride.data_file("train/agents/stride")
policy = stride.load_policy(folder / "best.safetensors")
potential = stride.Potential.load(folder / "potential.json")
env = stride.StrideEnv(observation="agent", potential=potential)
names = stride.StrideEnv().observation_names
q, u = names[0:3] + names[6:12], names[3:6] + names[12:18]
columns = ["time_s", *q, *u]
columns += [f"{kind}_{muscle}" for kind in ("activation", "fiber", "excitation") for muscle in policy.actions]
print("# stride recording 1\n# unit: SI, rad")
print(",".join(columns))

observation, info = env.reset(seed=0)
for step in range(500):
    if step % policy.action_repeat == 0:
        action = policy(observation[None])[0]
    if step >= 200:
        print(",".join(f"{x:.10g}" for x in [info["time_s"], *env.state, *action]))
    observation, _, _, _, info = env.step(action)
