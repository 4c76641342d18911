"""The environment of Gymnasium: its checks, its luck, and a learner of other people."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from table_rl.explorers.epsilon_greedy import ConstantEpsilonGreedy
from table_rl.learners.q_learning import QLearning
from table_rl.step_size_schedulers.basic_step_size_schedulers import ConstantStepSize

from abstransfer import (
    evaluate_policy,
    navigation_tasks,
    optimal_values,
    parse_map,
    q_learning,
)
from abstransfer.gymnasium import ID, Navigation
from abstransfer.learning import loop
from abstransfer.learning._runs import set_up
from abstransfer.learning.settings import Settings

TWO_ROOMS = parse_map("+-+---+-+\n|*d. .d*|\n| |   | |\n| |. .|*|\n+-+---+-+")


@pytest.mark.parametrize("render_mode", [None, "ansi", "rgb_array"])
@pytest.mark.parametrize(
    "options", [{}, {"reward": "goal"}, {"actions": "compass", "maps": TWO_ROOMS}]
)
def test_gymnasiums_own_check_passes_without_a_warning(render_mode, options):
    env = gymnasium.make(ID, render_mode=render_mode, **options)

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)


def test_an_episode_is_the_one_that_was_asked_for():
    env = Navigation(["source", TWO_ROOMS], reward="goal")
    state, info = env.reset(seed=1, options={"task": 12, "cell": 5})

    assert (info["task"], info["cell"]) == (12, 5)
    assert (env.tasks.task[state], env.tasks.cell[state]) == (12, 5)
    assert info["rho"] == env.tasks.rho[state]
    assert info["action_mask"].tolist() == env.tasks.available[state].tolist()
    starts = {env.reset(options={"task": 0})[1]["cell"] for _ in range(400)}
    assert len(starts) > 100
    assert env.tasks.goal[0] not in starts


@pytest.mark.parametrize(
    "options", [{"room": 1}, {"task": 11}, {"cell": 135}, {"task": 0, "cell": 16}]
)
def test_an_episode_that_there_is_not_is_refused(options):
    with pytest.raises(ValueError, match="options must name a task, a cell that is"):
        Navigation().reset(seed=1, options=options)


def test_no_step_is_taken_outside_an_episode():
    env = Navigation(parse_map("+---+\n|.d*|\n+---+"), success=1)
    with pytest.raises(ValueError, match="no episode is going on; call reset"):
        env.step(0)
    env.reset(seed=1)
    assert env.step(int(env.reset()[1]["action_mask"].argmax()))[2]
    with pytest.raises(ValueError, match="no episode is going on; call reset"):
        env.step(0)


def test_an_unknown_way_to_draw_is_refused():
    with pytest.raises(ValueError, match="render_mode must be one of .* got 'human'"):
        Navigation(render_mode="human")


def test_the_building_is_drawn_with_its_goal_and_the_robot():
    text = gymnasium.make(ID, maps=TWO_ROOMS, render_mode="ansi")
    text.reset(seed=1, options={"task": 1, "cell": 0})
    picture = gymnasium.make(ID, maps=TWO_ROOMS, render_mode="rgb_array")
    shots = []
    for cell in (0, 1):
        picture.reset(seed=1, options={"task": 1, "cell": cell})
        shots.append(picture.render())

    assert text.render() == "+-+---+-+\n|@d. .d*|\n| |   | |\n| |. .| |\n+-+---+-+"
    assert shots[0].shape == (250, 500, 3)
    assert shots[0].dtype == np.uint8
    left = np.s_[:125, :125]  # the robot's first cell
    assert shots[0][left].mean() < shots[1][left].mean()


def test_many_of_them_go_on_together():
    envs = gymnasium.make_vec(ID, num_envs=3, maps=TWO_ROOMS, reward="goal")
    state, info = envs.reset(seed=7)
    alone = [gymnasium.make(ID, maps=TWO_ROOMS, reward="goal") for _ in range(3)]
    begun = [env.reset(seed=7 + i) for i, env in enumerate(alone)]

    assert state.tolist() == [found for found, _ in begun]
    action = info["action_mask"].argmax(axis=1)
    state, reward, *_ = envs.step(action)
    steps = [env.step(int(a)) for env, a in zip(alone, action, strict=True)]
    assert state.tolist() == [step[0] for step in steps]
    assert reward.tolist() == [step[1] for step in steps]


def through_gymnasium(settings, n_steps, seed, **options):
    """Return Q, goals and cuts of our rule, step by step through the environment."""
    env = gymnasium.make(ID, max_episode_steps=settings.max_episode, **options)
    setup = set_up(settings)
    q, ended = settings.q0.copy(), [0, 0]
    s, info = env.reset(seed=seed)
    for t in range(1, n_steps + 1):
        a, _ = loop.choose(t, s, info["luck"], q, setup.guide, setup.rule)
        s_next, reward, is_goal, is_cut, info = env.step(int(a))
        target = reward + settings.gamma * loop.largest(q, s_next)
        q[s, a] = (1.0 - settings.alpha) * q[s, a] + settings.alpha * target
        s = s_next
        if is_goal or is_cut:
            ended[0 if is_goal else 1] += 1
            s, info = env.reset()
    return q, ended


@pytest.mark.parametrize(
    ("reward", "how"),
    [
        ("goal", {}),
        ("cost", {"tau": 1500, "strategy": "hard"}),
        ("goal", {"tau": 2500, "strategy": "soft"}),
    ],
    ids=["alone", "hard", "soft"],
)
def test_with_the_same_luck_it_is_the_run_of_our_own_loop(reward, how):
    """Every word of luck is shared, if the learner chooses by ``info["luck"]``."""
    tasks = navigation_tasks(TWO_ROOMS, reward=reward)
    guide = np.full(tasks.available.shape, 1 / 8) if how else None
    how = how | {"guide": guide, "max_episode": 40}
    native = q_learning(tasks.mdp, 4000, rng=2015, window=4000, **how)
    settings = Settings(tasks.mdp, **how)
    q, ended = through_gymnasium(settings, 4000, 2015, maps=TWO_ROOMS, reward=reward)

    assert ended == [native.goals.sum(), native.cuts.sum()]
    assert min(ended) > 0
    assert (q == native.q).all()


def test_a_learner_of_other_people_learns_the_way():
    """It draws luck of its own, so only its success can be compared."""
    env = gymnasium.make(ID, maps=TWO_ROOMS, reward="goal")
    n_states, n_actions = int(env.observation_space.n), int(env.action_space.n)
    np.random.seed(1)  # noqa: NPY002  the library draws from the global generator
    learner = QLearning(
        n_states,
        n_actions,
        ConstantStepSize(0.1),
        ConstantEpsilonGreedy(0.1, n_actions),
        discount=0.9,
    )
    s, _ = env.reset(seed=1)
    for _ in range(12_000):
        s, reward, is_goal, is_cut, _ = env.step(int(learner.act(s, True)))
        learner.observe(s, reward, is_goal, is_cut, True)
        if is_goal or is_cut:
            s, _ = env.reset()

    mdp = env.unwrapped.tasks.mdp
    greedy = np.eye(n_actions)[learner.q.argmax(axis=1)]
    lost = optimal_values(mdp) - evaluate_policy(mdp, greedy)
    assert lost.mean() < 0.02 < optimal_values(mdp).mean()
