"""StrideVectorEnv against as many single runners."""

import unittest

import numpy
import stride


class Vector(unittest.TestCase):
    def test_each_runner_lives_as_one_alone_whatever_the_threads(self):
        n, steps = 5, 200
        actions = numpy.random.default_rng(1).uniform(0, 1, (steps, n, 18))
        for threads in (1, 2, 3):
            env = stride.StrideVectorEnv(n=n, threads=threads, difficulty=2)
            rows = [env.reset(seed=11)[0].copy()]
            ends = []
            for action in actions:
                observations, _, terminated, truncated, _ = env.step(action)
                rows.append(observations.copy())
                ends.append(terminated | truncated)
            for i in range(n):
                single, seed = stride.StrideEnv(difficulty=2), 11 + i
                self.assertTrue(numpy.array_equal(single.reset(seed=seed)[0], rows[0][i]))
                over = False
                for k in range(steps):
                    if over:
                        seed += n
                        observation, _ = single.reset(seed=seed)
                        over = False
                    else:
                        observation, _, terminated, truncated, _ = single.step(actions[k, i])
                        over = terminated or truncated
                    self.assertTrue(numpy.array_equal(observation, rows[k + 1][i]))
                    self.assertEqual(over, ends[k][i])
            self.assertGreater(numpy.sum(ends), 0)

    def test_it_writes_into_the_same_arrays(self):
        env = stride.StrideVectorEnv(n=3)
        first, infos = env.reset(seed=1)
        observations, rewards, _, _, again = env.step(numpy.zeros((3, 18)))
        self.assertIs(first.base if first.base is not None else first, observations)
        self.assertIs(infos["time_s"], again["time_s"])
        numpy.testing.assert_allclose(rewards, again["forward"] + again["ligament"])

    def test_spaces_are_those_of_all_runners(self):
        env = stride.StrideVectorEnv(4)
        observations, _ = env.reset(seed=[4, 3, 2, 1])
        self.assertEqual(env.num_envs, 4)
        self.assertIn(observations, env.observation_space)
        self.assertEqual(env.action_space.shape, (4, 18))
        self.assertIn(env.action_space.sample(), env.action_space)

    def test_bad_input(self):
        for text, options in (
            ("n = 0", {"n": 0}),
            ("threads = 5000", {"threads": 5000}),
            ("wings: unknown option", {"wings": 2}),
        ):
            with self.assertRaisesRegex(stride.Error, text):
                stride.StrideVectorEnv(**options)
        env = stride.StrideVectorEnv(n=2)
        with self.assertRaisesRegex(stride.Error, "reset"):
            env.step(numpy.zeros((2, 18)))
        env.reset(seed=1)
        with self.assertRaisesRegex(stride.Error, r"shape \(18,\), \(2, 18\) is needed"):
            env.step(numpy.zeros(18))
        with self.assertRaisesRegex(stride.Error, "3 seeds, 2 are needed"):
            env.reset(seed=[1, 2, 3])


if __name__ == "__main__":
    unittest.main()
