"""Potential and Policy."""

import os
import tempfile
import unittest

import numpy
import stride

AGENT = stride.data_file("train/agents/stride")


class PotentialTest(unittest.TestCase):
    def setUp(self):
        self.potential = stride.Potential.load(AGENT / "potential.json")

    def test_it_is_highest_on_the_demonstration(self):
        phases = numpy.linspace(0, 1, 17)
        poses = self.potential.targets(phases)
        on = self.potential(poses, phases)
        away = self.potential(poses + 0.05, phases)
        self.assertEqual(on.shape, (17,))
        self.assertTrue(numpy.all(on > away))
        # pf3 of five parts at distance 0: 1 / epsilon^2 each.
        numpy.testing.assert_allclose(
            on, self.potential.weight * 5 / self.potential.epsilon_m**2, rtol=1e-9
        )

    def test_shaping_rewards_telescope(self):
        phi = numpy.random.default_rng(1).uniform(0, 9, 50)
        gamma = 0.97
        rewards = stride.shaping_reward(phi[:-1], phi[1:], gamma, numpy.zeros(49, bool))
        total = numpy.sum(gamma ** numpy.arange(49) * rewards)
        self.assertAlmostEqual(total, gamma**49 * phi[-1] - phi[0], 10)
        self.assertEqual(stride.shaping_reward([2.0], [7.0], gamma, [True])[0], -2.0)

    def test_the_environment_tells_its_value(self):
        env = stride.StrideEnv(potential=self.potential)
        env.reset(seed=1)
        _, _, _, _, info = env.step(numpy.full(18, 0.2))
        self.assertEqual(info["phi"], self.potential(env.pose[None], [info["phase"]])[0])
        self.assertAlmostEqual(info["phase"], self.potential.phase_at(0.01), 12)

    def test_one_of_another_model_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "other.potential.json")
            with open(AGENT / "potential.json") as given, open(file, "w") as out:
                out.write(given.read().replace(self.potential.model, "gait2354"))
            with self.assertRaisesRegex(stride.Error, "the model gait2354, the runner is"):
                stride.StrideEnv(potential=stride.Potential.load(file))
            with self.assertRaisesRegex(stride.Error, "none.json"):
                stride.Potential.load(os.path.join(folder, "none.json"))

    def test_shapes(self):
        with self.assertRaisesRegex(stride.Error, r"\(n, 9\) and \(n,\) are needed"):
            self.potential(numpy.zeros((3, 8)), numpy.zeros(3))


class PolicyTest(unittest.TestCase):
    def test_the_agent_that_ships_runs(self):
        policy = stride.load_policy(AGENT / "best.safetensors")
        potential = stride.Potential.load(AGENT / "potential.json")
        env = stride.StrideEnv(
            observation="agent", potential=potential, action_repeat=policy.action_repeat
        )
        self.assertEqual(env.observation_names, policy.features)
        self.assertEqual(env.action_names, policy.actions)
        observation, info = env.reset(seed=0)
        over = False
        while not over:
            observation, _, terminated, truncated, info = env.step(policy(observation[None])[0])
            over = terminated or truncated
        self.assertTrue(truncated)
        self.assertGreater(info["distance_m"], 44)

    def test_rows_do_not_know_of_each_other(self):
        policy = stride.load_policy(AGENT / "best.safetensors")
        features = numpy.random.default_rng(1).standard_normal((7, len(policy.features)))
        together = policy(features)
        for row, alone in zip(together, features):
            numpy.testing.assert_array_equal(row, policy(alone[None])[0])

    def test_bad_input(self):
        policy = stride.load_policy(AGENT / "best.safetensors")
        with self.assertRaisesRegex(stride.Error, "is needed"):
            policy(numpy.zeros((1, 3)))
        with self.assertRaisesRegex(stride.Error, "potential.json"):
            stride.load_policy(AGENT / "potential.json")


if __name__ == "__main__":
    unittest.main()
