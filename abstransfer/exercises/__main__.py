"""``python -m abstransfer.exercises``: all exercises, for who writes a page."""

import inspect

from . import all_exercises, all_open_exercises

for exercise in all_exercises():
    print(f"{exercise.key}  {exercise.task}")
    if exercise.cases:
        print(f"    def {exercise.name}{inspect.signature(exercise.solution)}")
    for number, hint in enumerate(exercise.hints, 1):
        print(f"    {number}. {hint}")
    print("    knows:", "; ".join(wrong.name for wrong in exercise.wrong))
for exercise in all_open_exercises():
    print(f"{exercise.key}  (open)")
    for number, hint in enumerate(exercise.hints, 1):
        print(f"    {number}. {hint}")
    print("    a good answer holds:", exercise.good)
