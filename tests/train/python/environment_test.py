"""StrideEnv: what Gymnasium's checker asks of an environment, and the bytes of the C++ side."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy
import stride

COMPETITION = (
    "pelvis_tilt pelvis_tx pelvis_ty pelvis_tilt_u pelvis_tx_u pelvis_ty_u "
    "hip_flexion_r knee_angle_r ankle_angle_r hip_flexion_l knee_angle_l ankle_angle_l "
    "hip_flexion_r_u knee_angle_r_u ankle_angle_r_u hip_flexion_l_u knee_angle_l_u ankle_angle_l_u "
    "com_x com_y com_vx com_vy head_x head_y pelvis_x pelvis_y torso_x torso_y toes_l_x toes_l_y "
    "toes_r_x toes_r_y talus_l_x talus_l_y talus_r_x talus_r_y strength_psoas_l strength_psoas_r "
    "obstacle_x obstacle_y obstacle_radius"
).split()

STAND_IN = {
    "__init__": """
import importlib
from . import spaces, vector
registry = {}
class Env:
    pass
def register(id, entry_point, vector_entry_point):
    registry[id] = (entry_point, vector_entry_point)
def made(entry_point, **options):
    module, name = entry_point.split(":")
    return getattr(importlib.import_module(module), name)(**options)
def make(id, **options):
    return made(registry[id][0], **options)
def make_vec(id, num_envs, **options):
    return made(registry[id][1], num_envs=num_envs, **options)
""",
    "spaces": """
class Box:
    def __init__(self, low, high, shape, dtype):
        self.low, self.high, self.shape, self.dtype = low, high, shape, dtype
    def seed(self, seed=None):
        return seed
""",
    "vector": """
import enum
class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
class VectorEnv:
    pass
""",
}

USE_OF_THE_STAND_IN = """
import gymnasium, stride
assert "Stride-v0" in gymnasium.registry
one = gymnasium.make("Stride-v0", rules="nips2017")
many = gymnasium.make_vec("Stride-v0", 3)
assert isinstance(one, gymnasium.Env) and isinstance(many, gymnasium.vector.VectorEnv)
assert isinstance(one.action_space, gymnasium.spaces.Box)
observation, info = one.reset(seed=4)
print(*observation.shape, *one.action_space.shape, many.reset(seed=4)[0].shape[0] == 3)
"""


def bytes_in_python(actions, seed, **options):
    env = stride.StrideEnv(**options)
    rows = [env.reset(seed=seed)[0]]
    over = False
    for action in actions:
        if over:
            seed += 1
            rows.append(env.reset(seed=seed)[0])
            over = False
            continue
        observation, reward, terminated, truncated, _ = env.step(action)
        over = terminated or truncated
        rows += [observation, [reward, terminated, truncated]]
    return numpy.concatenate(rows).tobytes()


def bytes_in_cpp(actions, seed, rules, difficulty, engine):
    with tempfile.TemporaryDirectory() as folder:
        given, out = os.path.join(folder, "actions"), os.path.join(folder, "out")
        actions.tofile(given)
        program = os.environ["STRIDE_EPISODE_BYTES"]
        subprocess.run(
            [program, rules, str(difficulty), engine, str(seed), given, out], check=True
        )
        with open(out, "rb") as file:
            return file.read()


class RoundTrip(unittest.TestCase):
    """1000 random steps give the bytes of the C++ environment."""

    def check(self, rules, difficulty, engine="planar", steps=1000):
        actions = numpy.random.default_rng(7).uniform(-0.1, 1.1, (steps, 18))
        actions = numpy.repeat(actions[::10], 10, axis=0)
        ours = bytes_in_python(actions, 3, rules=rules, difficulty=difficulty, engine=engine)
        self.assertEqual(ours, bytes_in_cpp(actions, 3, rules, difficulty, engine))

    def test_clean(self):
        self.check("clean", 0)

    def test_obstacles_and_weak_muscles(self):
        self.check("clean", 2)

    def test_rules_of_the_competition(self):
        self.check("nips2017", 2)

    def test_reference_engine(self):
        self.check("clean", 1, engine="simbody", steps=100)


class Contract(unittest.TestCase):
    def test_spaces_hold_what_the_environment_gives(self):
        env = stride.StrideEnv(difficulty=2)
        observation, info = env.reset(seed=1)
        self.assertIn(observation, env.observation_space)
        self.assertEqual(observation.dtype, env.observation_space.dtype)
        self.assertIsInstance(info, dict)
        action = env.action_space.sample()
        self.assertIn(action, env.action_space)
        observation, reward, terminated, truncated, info = env.step(action)
        self.assertIn(observation, env.observation_space)
        self.assertIs(type(reward), float)
        self.assertIs(type(terminated), bool)
        self.assertIs(type(truncated), bool)
        self.assertEqual(reward, info["forward"] + info["ligament"])

    def test_the_same_seed_gives_the_same_episode(self):
        def episode(env, **reset):
            rows = [env.reset(**reset)[0]]
            for k in range(50):
                rows.append(env.step(numpy.full(18, 0.3 + 0.01 * k))[0])
            return numpy.array(rows)

        env = stride.StrideEnv(difficulty=2)
        first, second = episode(env, seed=5), episode(env)
        numpy.testing.assert_array_equal(first, episode(env, seed=5))
        numpy.testing.assert_array_equal(second, episode(env))
        self.assertFalse(numpy.array_equal(first, second))

    def test_observations_are_copies(self):
        env = stride.StrideEnv()
        first, _ = env.reset(seed=1)
        kept = first.copy()
        env.step(numpy.ones(18))
        numpy.testing.assert_array_equal(first, kept)

    def test_a_fall_terminates_and_the_time_limit_truncates(self):
        env = stride.StrideEnv(max_steps=20)
        env.reset(seed=1)
        ends = [env.step(numpy.zeros(18))[2:4] for _ in range(20)]
        self.assertEqual(ends[-1], (False, True))
        self.assertNotIn((True, False), ends)
        env = stride.StrideEnv()
        env.reset(seed=1)
        steps = 0
        while True:
            _, _, terminated, truncated, info = env.step(numpy.zeros(18))
            steps += 1
            if terminated or truncated:
                break
        self.assertTrue(terminated and not truncated)
        self.assertAlmostEqual(info["time_s"], 0.01 * steps)
        self.assertLess(env.pose[0], 0.65)

    def test_the_41_observations_are_in_the_order_of_the_competition(self):
        for rules in ("clean", "nips2017"):
            self.assertEqual(stride.StrideEnv(rules=rules).observation_names, COMPETITION)

    def test_an_action_that_is_repeated_is_so_many_steps(self):
        once, thrice = stride.StrideEnv(), stride.StrideEnv(action_repeat=3)
        once.reset(seed=1), thrice.reset(seed=1)
        action = numpy.full(18, 0.4)
        rewards = [once.step(action)[1] for _ in range(3)]
        observation, reward, *_ = thrice.step(action)
        numpy.testing.assert_array_equal(observation, once._arrays["observations"][0])
        self.assertAlmostEqual(reward, sum(rewards), 14)

    def test_pictures_are_rgb(self):
        env = stride.StrideEnv(render_mode="rgb_array", width_px=320, height_px=180)
        env.reset(seed=1)
        picture = env.render()
        self.assertEqual((picture.shape, picture.dtype), ((180, 320, 3), numpy.uint8))
        self.assertGreater(picture.std(), 5)
        self.assertIsNone(stride.StrideEnv().render())

    def test_gymnasium_knows_it_where_it_is_installed(self):
        try:
            import gymnasium
            from gymnasium.utils.env_checker import check_env
        except ImportError:
            self.skipTest("gymnasium is not installed")
        check_env(gymnasium.make("Stride-v0").unwrapped, skip_render_check=True)

    def test_registers_itself_with_what_offers_gymnasiums_interface(self):
        # Debian has no gymnasium: a stand-in with the names that the module asks for.
        with tempfile.TemporaryDirectory() as folder:
            package = os.path.join(folder, "gymnasium")
            os.mkdir(package)
            for name, text in STAND_IN.items():
                with open(os.path.join(package, name + ".py"), "w") as file:
                    file.write(text)
            path = os.pathsep.join([folder, os.environ["PYTHONPATH"]])
            said = subprocess.run(
                [sys.executable, "-B", "-c", USE_OF_THE_STAND_IN],
                env={**os.environ, "PYTHONPATH": path},
                capture_output=True,
                text=True,
            )
        self.assertEqual((said.stdout, said.stderr), ("41 18 True\n", ""))


class BadInput(unittest.TestCase):
    def refused(self, text, call, *args, **options):
        with self.assertRaises(stride.Error) as caught:
            call(*args, **options)
        self.assertIn(text, str(caught.exception))

    def test_options(self):
        make = stride.StrideEnv
        self.refused("rules", make, rules="2018")
        self.refused("gravity: unknown option", make, gravity=9.8)
        self.refused("n: unknown option", make, n=2)
        self.refused("difficulty", make, difficulty=3)
        self.refused("max_obstacles = 'many': is of the wrong type", make, max_obstacles="many")
        self.refused("observation = pixels", make, observation="pixels")
        self.refused("engine", make, engine="mujoco")
        self.refused("none.osim", make, model="none.osim")
        self.refused("render_mode", make, render_mode="human")

    def test_actions(self):
        env = stride.StrideEnv()
        self.refused("reset", env.step, numpy.zeros(18))
        env.reset(seed=1)
        self.refused("shape (17,), (1, 18) is needed", env.step, numpy.zeros(17))
        action = numpy.zeros(18)
        action[3] = numpy.nan
        self.refused("actions: nan at runner 0, muscle", env.step, action)
        env.step(numpy.zeros(18))  # it goes on

    def test_after_the_end(self):
        env = stride.StrideEnv(max_steps=1)
        env.reset(seed=1)
        env.step(numpy.zeros(18))
        self.refused("reset", env.step, numpy.zeros(18))

    def test_seeds(self):
        self.refused("seed = -1", stride.StrideEnv().reset, seed=-1)
        self.refused("options", stride.StrideEnv().reset, options={"x": 1})


if __name__ == "__main__":
    unittest.main()
