"""
Learners of other libraries, on the same task.

Each is driven by the same small loop in plain Python, so the time is that of its
learner and of this loop (under a microsecond a step).  None can follow a guide.
"""

import random
import time


class Task:
    """The MDP as lists, the quickest form for plain Python."""

    def __init__(self, settings, seed):
        mdp = settings.mdp
        self.random = random.Random(seed)
        self.next_state = mdp.next_state.tolist()
        self.cumulative = mdp.prob.cumsum(axis=2).tolist()
        self.reward = mdp.reward.tolist()
        self.terminal = mdp.terminal.tolist()
        self.start = settings.start.tolist()
        self.max_episode = settings.max_episode
        self.left = 0

    def restart(self):
        self.left = self.max_episode
        return self.random.choice(self.start)

    def step(self, s, a):
        u, bounds, k = self.random.random(), self.cumulative[s][a], 0
        while k < len(bounds) - 1 and u >= bounds[k]:
            k += 1
        self.left -= 1
        return self.next_state[s][a][k]


def table_rl(settings, seed):
    """table-rl: an array, argmax with ties at random."""
    import numpy as np
    from table_rl.explorers.epsilon_greedy import ConstantEpsilonGreedy
    from table_rl.learners.q_learning import QLearning
    from table_rl.step_size_schedulers.basic_step_size_schedulers import (
        ConstantStepSize,
    )

    np.random.seed(seed)  # noqa: NPY002  the library draws from the global generator
    n_states, n_actions = settings.mdp.allowed.shape
    learner = QLearning(
        n_states,
        n_actions,
        ConstantStepSize(settings.alpha),
        ConstantEpsilonGreedy(settings.epsilon, n_actions),
        discount=settings.gamma,
    )
    task = Task(settings, seed)
    s = task.restart()

    def advance(first, last):
        nonlocal s
        for _ in range(first, last + 1):
            s_next = task.step(s, learner.act(s, True))
            over, cut = task.terminal[s_next], task.left == 0
            learner.observe(s_next, task.reward[s_next], over, cut, True)
            s = task.restart() if over or cut else s_next

    return advance


def simple_rl(settings, seed):
    """simple_rl: dictionaries keyed by state objects, ties at random."""
    time.clock = time.perf_counter  # which it calls, and Python 3.8 took away
    import numpy as np
    from simple_rl.agents.QLearningAgentClass import QLearningAgent
    from simple_rl.mdp.StateClass import State

    np.random.seed(seed)  # noqa: NPY002  as above
    random.seed(seed)
    mdp, task = settings.mdp, Task(settings, seed)
    states = [State([s], bool(mdp.terminal[s])) for s in range(mdp.n_states)]
    rates = {"alpha": settings.alpha, "gamma": settings.gamma}
    agent = QLearningAgent(list(range(8)), epsilon=settings.epsilon, **rates)
    s, reward = task.restart(), 0.0

    def advance(first, last):
        nonlocal s, reward
        for _ in range(first, last + 1):
            s = task.step(s, agent.act(states[s], reward))
            reward = task.reward[s]
            if task.terminal[s] or task.left == 0:
                agent.act(states[s], reward)
                agent.end_of_episode()
                s, reward = task.restart(), 0.0

    return advance
