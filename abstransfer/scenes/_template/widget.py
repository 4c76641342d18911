"""A scene to copy: a coin is thrown, and the share of heads comes close to a half."""

from __future__ import annotations

import numpy as np
import traitlets

from ..base import Scene

MOST = 200  # throws


class Template(Scene):
    """
    A coin is thrown: the share of heads comes close to a half.

    Parameters
    ----------
    n : int, 1 to 200
        How many throws are looked at.
    luck : int, 1 to 50
        Which random numbers.

    Examples
    --------
    >>> scene = Template(n=4)
    >>> scene.shares[: scene.n].round(2).tolist()  # of heads, after each throw
    [0.0, 0.0, 0.0, 0.25]
    """

    scene = "template"  # the name of the folder
    constants = {"most": MOST}  # more that the script shall know
    n = traitlets.Int(20, min=1, max=MOST).tag(sync=True)
    luck = traitlets.Int(1, min=1, max=50).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)

    @property
    def shares(self) -> np.ndarray:
        """The share of heads after each of all throws."""
        words = np.random.SeedSequence(self.luck).generate_state(MOST)
        heads = words >> np.uint32(31)  # the first bit: 1 is heads
        return heads.cumsum() / np.arange(1, MOST + 1)
