"""Buildings of any size, for tests."""

import numpy as np

from abstransfer.maps import DOOR, Map, parse_map


def tile_map(map_: Map, rows: int, columns: int) -> Map:
    """
    Return a building of rows x columns copies, neighbours joined by one door.

    For measuring how cost grows with the size of a building.
    """
    if rows < 1 or columns < 1:
        raise ValueError(f"rows and columns must be at least 1, got {rows}, {columns}")
    height, width = map_.shape
    chars = np.full((2 * height * rows + 1, 2 * width * columns + 1), "+")
    for i in range(rows):
        for j in range(columns):
            top, left = 2 * height * i, 2 * width * j
            chars[top : top + 2 * height + 1, left : left + 2 * width + 1] = map_.chars
    middle_row, middle_column = 2 * (height // 2) + 1, 2 * (width // 2) + 1
    chars[middle_row :: 2 * height, 2 * width : -1 : 2 * width] = DOOR
    chars[2 * height : -1 : 2 * height, middle_column :: 2 * width] = DOOR
    return parse_map("\n".join("".join(line) for line in chars))
