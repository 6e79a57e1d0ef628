"""A runner learns to stay up by the cross-entropy method, in numpy: cross_entropy.mp4.

The policy is linear in the 41 observations and the same for both legs; 64 runners try one each.
"""

import sys

import numpy
import stride

generations = int(sys.argv[1]) if len(sys.argv) > 1 else 40
n, elite, seconds = 64, 8, 4.0
random = numpy.random.default_rng(1)
env = stride.StrideVectorEnv(n=n, max_steps=int(100 * seconds), action_repeat=4)
names = env.observation_names
seen = [i for i, name in enumerate(names) if not name.startswith(("strength", "obstacle"))]
features, muscles = len(seen) + 1, env.single_action_space.shape[0]
pelvis_x = seen.index(names.index("pelvis_tx"))


def act(weights, observations):
    x = observations[:, seen].copy()
    x[:, [i for i, j in enumerate(seen) if names[j].endswith("_x")]] -= x[:, [pelvis_x]]
    x[:, pelvis_x] = 0
    x = numpy.concatenate([x, numpy.ones((len(x), 1))], axis=1)
    return 1 / (1 + numpy.exp(-numpy.einsum("nfm,nf->nm", weights, x)))


def scores(weights):
    """Seconds on its feet, and a little for each metre forward."""
    observations, infos = env.reset(seed=1)
    score, alive = numpy.zeros(len(weights)), numpy.ones(len(weights), bool)
    while alive.any():
        observations, _, terminated, truncated, infos = env.step(act(weights, observations))
        score[alive] = infos["time_s"][alive] + 0.2 * infos["distance_m"][alive]
        alive &= ~(terminated | truncated)
    return score


mean, sd = numpy.zeros((features, muscles)), numpy.full((features, muscles), 0.5)
mean[-1] = -2.0  # muscles at rest
for generation in range(generations):
    weights = mean + sd * random.standard_normal((n, features, muscles))
    score = scores(weights)
    best = weights[numpy.argsort(score)[-elite:]]
    mean, sd = 0.3 * mean + 0.7 * best.mean(0), 0.3 * sd + 0.7 * best.std(0) + 0.01
    print(f"generation {generation + 1}: mean {score.mean():.2f}, best {score.max():.2f}", flush=True)

single = stride.StrideEnv(max_steps=int(100 * seconds), action_repeat=4, render_mode="rgb_array")
observation, info = single.reset(seed=1)
over, pictures = False, [single.render()]
while not over:
    observation, _, terminated, truncated, info = single.step(act(mean[None], observation[None])[0])
    over = terminated or truncated
    pictures.append(single.render())
stride.write_film("cross_entropy.mp4", pictures, rate_hz=25)
print(f"{info['time_s']:.2f} s on its feet, {info['distance_m']:.2f} m: cross_entropy.mp4")
