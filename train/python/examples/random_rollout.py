"""A runner under random excitations, held for a tenth of a second, on film: random_rollout.mp4."""

import sys

import stride

seed = int(sys.argv[1]) if len(sys.argv) > 1 else 1
env = stride.StrideEnv(difficulty=1, render_mode="rgb_array")
env.action_space.seed(seed)
observation, info = env.reset(seed=seed)

pictures, total = [env.render()], 0.0
terminated = truncated = False
while not (terminated or truncated):
    if len(pictures) % 10 == 1:
        action = env.action_space.sample()
    observation, reward, terminated, truncated, info = env.step(action)
    total += reward
    pictures.append(env.render())

stride.write_film("random_rollout.mp4", pictures, rate_hz=env.metadata["render_fps"])
print(
    f"{'fell' if terminated else 'stood'} after {info['time_s']:.2f} s and {info['distance_m']:.2f} m, "
    f"reward {total:.3f}: random_rollout.mp4"
)
