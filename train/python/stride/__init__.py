"""Stride from Python: the muscle-driven runner of "Learning to Run" as an environment.

    env = stride.StrideEnv(difficulty=1)
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

StrideVectorEnv steps many runners in threads. Potential gives the shaping reward of a video,
load_policy() the actions of a trained agent. Names follow Gymnasium, which is not needed; where it
is installed, gymnasium.make("Stride-v0") works.
"""

from ._stride import Error, Policy, Potential, Runners, data_file, shaping_reward, write_film
from ._stride import version as __version__
from .environment import StrideEnv
from .spaces import Box
from .vector import StrideVectorEnv

load_policy = Policy

__all__ = [
    "Box",
    "Error",
    "Policy",
    "Potential",
    "StrideEnv",
    "StrideVectorEnv",
    "data_file",
    "load_policy",
    "shaping_reward",
    "write_film",
]


def _register():
    try:
        import gymnasium
    except ImportError:
        return
    if "Stride-v0" not in gymnasium.registry:
        gymnasium.register(
            id="Stride-v0", entry_point="stride:StrideEnv", vector_entry_point="stride:StrideVectorEnv"
        )


_register()
