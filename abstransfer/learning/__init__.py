"""
Q-learning, alone or guided by a policy.

``loop`` is one plain step after another, which page 3 of the book teaches; what starts
with an underscore makes the same steps fast.
"""

from .learner import Learner, QLearningResult, Trace, q_learning, q_learning_runs

__all__ = ["Learner", "QLearningResult", "Trace", "q_learning", "q_learning_runs"]
