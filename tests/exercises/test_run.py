"""Nothing that an answer does escapes `check`: no error, no loop, no trace of it."""

import _thread
import builtins
import contextlib
import os
import random
import sys
import threading
import warnings

import numpy as np
import pytest

from abstransfer.exercises import _check, _run, check

RIGHT = _check.exercises_of(8)["ex-8-1"].solution


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    monkeypatch.setattr(_check, "_tries", {})


def told(body):
    """Reply to a function that does something and then returns the right answer."""

    def advice_probability(t, tau):
        body()
        return RIGHT(t, tau)

    return check("ex-8-1", advice_probability)


# ---- errors


class Silent(Exception):
    def __str__(self):
        raise RuntimeError("I do not say")


class SilentForEver(BaseException):
    def __str__(self):
        raise SilentForEver


class Nameless(type):
    def __getattribute__(cls, name):
        if name == "__subclasses__":  # what a library asks of every error there is
            return super().__getattribute__(name)
        raise RuntimeError("no name")


class Own(BaseException):
    pass


class OddText(str):
    def __str__(self):
        raise RuntimeError("no")

    __repr__ = __format__ = strip = lower = __str__


def raising(error):
    def body():
        raise error

    return body


@pytest.mark.parametrize(
    "error",
    [
        Silent(),
        SilentForEver(),
        Own("mine"),
        GeneratorExit(),
        KeyboardInterrupt(),
        SystemExit(3),
        StopIteration(),
        MemoryError(),
        ValueError(OddText("odd")),
        ExceptionGroup("many", [ValueError("a")]),
    ],
    ids=lambda error: type(error).__name__,
)
def test_any_error_of_an_answer_is_told_in_words(error):
    reply = told(raising(error))

    assert reply.verdict == "no answer yet"
    assert f"Your function stopped with `{type(error).__name__}" in reply.text
    assert "called with t=" in reply.text


def test_an_error_without_a_name_is_told_in_words():
    error = Nameless("OfNoName", (Exception,), {})()  # pytest asks a class of a module

    assert "an error that cannot say what it is" in told(raising(error)).text


class Strange:
    """Raises whatever it is asked."""

    def __array__(self, *args, **kwargs):
        raise SilentForEver

    __getattribute__ = __repr__ = __len__ = __iter__ = __float__ = __array__


@pytest.mark.parametrize("key", ["ex-1-2", "ex-7-4", "ex-8-1"])
def test_an_object_that_answers_no_question_is_told_in_words(key):
    assert check(key, Strange()).verdict == "no answer yet"
    assert told(lambda: None)


def test_a_text_that_cannot_be_shown_is_read_all_the_same():
    assert check("ex-1-2", OddText("100"))
    assert check("ex-7-4", OddText("No"))
    assert not check(OddText("ex-1-2 "), 100)


def test_a_long_and_coloured_error_is_shortened():
    reply = told(raising(ValueError("\x1b[31m`very`\n" + "long " * 20_000)))

    assert len(reply.text) < 500
    assert "[31m'very' long long" in reply.text
    assert str(reply).isprintable() or "\n" in str(reply)
    assert "\x1b" not in str(reply)


# ---- prints


def test_what_an_answer_prints_is_told_once_and_shortly(capfd):
    def body():
        print("here", "I am " * 1000)
        print("and here", file=sys.stderr)

    reply = told(body)

    assert reply
    assert reply.text.count("It printed: `here I am I am") == 1
    assert len(reply.text) < 300
    assert capfd.readouterr() == ("", "")


def test_the_print_of_the_case_that_is_shown_is_told():
    def advice_probability(t, tau):
        print(f"t is {t}, tau is {tau}")
        return 0.5

    text = check("ex-8-1", advice_probability).text

    assert "called with t=1, tau=1." in text
    assert "It printed: `t is 1, tau is 1`" in text


def test_what_was_printed_before_an_error_is_told():
    def body():
        print("so far so good")
        raise ValueError

    assert "It printed: `so far so good`" in told(body).text


def test_input_is_refused_without_waiting():
    assert "asks with `input`" in told(lambda: input("? ")).text
    assert builtins.input is not _run._no_input


# ---- traces

HARM = {
    "numpy's luck": (
        lambda: np.random.seed(1),  # noqa: NPY002
        lambda: np.random.get_state()[1].tolist(),  # noqa: NPY002
    ),
    "numpy's generator": (
        lambda: np.random.set_bit_generator(np.random.PCG64(1)),
        np.random.get_bit_generator,
    ),
    "Python's luck": (lambda: random.seed(1), random.getstate),
    "print options": (
        lambda: np.set_printoptions(precision=1),
        np.get_printoptions,
    ),
    "numpy's errors": (lambda: np.seterr(all="raise"), np.geterr),
    "warnings": (
        lambda: warnings.simplefilter("error"),
        lambda: list(warnings.filters),
    ),
    "the environment": (
        lambda: os.environ.update(LANG="xx", NEW="1"),
        lambda: dict(os.environ),
    ),
    "the folder": (lambda: os.chdir(os.path.sep), os.getcwd),
    "the depth of calls": (lambda: sys.setrecursionlimit(4321), sys.getrecursionlimit),
    "the output": (
        lambda: setattr(sys, "stdout", None),
        lambda: (sys.stdout, sys.stderr),
    ),
    "input": (lambda: setattr(builtins, "input", None), lambda: builtins.input),
}


@pytest.mark.parametrize(("harm", "seen"), HARM.values(), ids=HARM)
def test_nothing_of_an_answer_stays(harm, seen):
    before = seen()

    assert told(harm)
    assert seen() == before


def test_nothing_stays_of_an_answer_that_fails():
    def body():
        os.environ["NEW"] = "1"
        raise ValueError

    assert not told(body)
    assert "NEW" not in os.environ


# ---- loops


def left_behind(before):
    """Return the threads that were not there before and do not end."""
    new = set(threading.enumerate()) - before
    for thread in new:
        thread.join(60)  # they are ending
    return {thread for thread in new if thread.is_alive()}


def for_ever():
    while True:
        pass


def deaf():
    while True:
        with contextlib.suppress(Exception):
            for_ever()


def prints_for_ever():
    while True:
        print("again")


def adds_for_ever():
    def ones():
        while True:
            yield 1

    sum(ones())


@pytest.mark.parametrize("loop", [for_ever, deaf, prints_for_ever, adds_for_ever])
def test_an_endless_loop_is_stopped_with_a_word(loop, monkeypatch):
    before = set(threading.enumerate())
    monkeypatch.setattr(_run, "LIMIT", 0.05)
    monkeypatch.setattr(_run, "PATIENCE", 60)  # it ends at once

    reply = told(loop)

    assert reply.verdict == "no answer yet"
    assert "did not come to an end within 0.05 seconds and was stopped" in reply.text
    assert not left_behind(before)


def test_an_answer_that_cannot_be_stopped_is_left_behind_with_a_word(monkeypatch):
    freed = threading.Event()
    monkeypatch.setattr(_run, "LIMIT", 0.05)
    monkeypatch.setattr(_run, "PATIENCE", 0.05)

    reply = told(freed.wait)  # a single call into compiled code
    freed.set()

    assert "could not be stopped and still runs. Restart the kernel." in reply.text
    monkeypatch.setattr(_run, "LIMIT", 60)
    assert told(lambda: None), "the next answer is judged as ever"


def test_something_without_end_is_read_as_far_as_needed():
    reply = check("ex-1-2", iter(int, 1))

    assert "One number is asked for" in reply.text


def test_an_interruption_stays_one_after_the_answer_was_stopped():
    """As by the button of a notebook: the cells below do not run."""
    before, place = set(threading.enumerate()), os.getcwd()

    def body():
        os.chdir(os.path.sep)
        _thread.interrupt_main()
        for_ever()

    with pytest.raises(KeyboardInterrupt, match="the answer was not judged"):
        told(body)

    assert not left_behind(before)
    assert os.getcwd() == place
