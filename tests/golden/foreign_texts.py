"""Maps as people have them: in other formats, and ours after a journey."""

OURS = """\
+---+---+
|   |   |
|   |   |
|*  d  *|
+d--+---+
|. . . .|
+-------+"""
BOX = """\
┌───┬───┐
│   │   │
│   │   │
│*  d  *│
├d──┴───┤
│. . . .│
└───────┘"""
DOUBLE = BOX.translate(str.maketrans("┌─┬┐│├┴┤└┘", "╔═╦╗║╠╩╣╚╝"))

# Read as OURS: nothing but harmless differences.
HARMLESS = {
    "windows": OURS.replace("\n", "\r\n") + "\r\n",
    "dos end of file": OURS.replace("\n", "\r\n") + "\r\n\x1a",
    "blanks at line ends": OURS.replace("|\n", "|  \n") + " ",
    "byte-order mark": "\ufeff" + OURS,
    "indent": "\n".join("    " + line for line in OURS.split("\n")),
    "indent of tabs": "\n".join("\t" + line for line in OURS.split("\n")),
    "tabs of four": OURS.replace("|   |   |", "|\t|\t|"),
    "fence": f"```\n{OURS}\n```\n",
    "named fence": f"~~~text\n{OURS}\n~~~\n",
    "comment": f"# two rooms\n\n{OURS}\n# drawn on a train",
    "comment in a fence": f"```\n# two rooms\n{OURS}\n```",
    "en dashes": OURS.replace("---", "\u2013\u2013\u2013"),
    "em dashes, minus": OURS.replace("---", "\u2014\u2212\u2014"),
    "no-break blanks": OURS.replace(" ", "\u00a0"),
    "box drawing": BOX,
    "double lines": DOUBLE,
}

TWO_BY_THREE = "+-+---+\n| |*  |\n|   +-+\n|     |\n+-----+"

# Mazes with cells of several characters: the maps they mean.
LARGER_CELLS = {
    "goal in the middle": (
        "+---+---+---+\n|   | *     |\n+   +   +---+\n|           |\n+---+---+---+",
        TWO_BY_THREE,
    ),
    "goal at the side": (
        "+---+---+---+\n|   |*      |\n+   +   +---+\n|           |\n+---+---+---+",
        TWO_BY_THREE,
    ),
    "letters": (
        "+---+---+---+\n|   | G     |\n+   +   +---+\n| S         |\n+---+---+---+",
        TWO_BY_THREE,
    ),
    "micromouse": (
        "o---o---o---o\n|   | G     |\no   o   o---o\n| S         |\no---o---o---o",
        TWO_BY_THREE,
    ),
    "two characters": (
        "+--+--+--+\n|  | *   |\n+  +  +--+\n|        |\n+--+--+--+",
        TWO_BY_THREE,
    ),
    "four by two": (
        "+----+----+----+\n|    |         |\n|    |  *      |\n"
        "+    +    +----+\n|              |\n|              |\n+----+----+----+",
        TWO_BY_THREE,
    ),
    "five by three": (
        "+-----+-----+-----+\n"
        "|     |           |\n|     |  G        |\n|     |           |\n"
        "+     +     +-----+\n"
        "|                 |\n|                 |\n|                 |\n"
        "+-----+-----+-----+",
        TWO_BY_THREE,
    ),
    "doors and corridor": (
        "+---+---+\n| * d . |\n+---+   +\n| * d . |\n+---+---+",
        "+-+-+\n|*d.|\n+-+ |\n|*d.|\n+-+-+",
    ),
    "box drawing": (
        "┌───┬───┬───┐\n│   │ * │   │\n├───┼─d─┼───┤\n│   d   d   │\n└───┴───┴───┘",
        None,  # two cells that nothing reaches
    ),
}

# Formats of others, with the name that the refusal gives them.
NAMED = {
    "a MovingAI map": (
        "type octile\nheight 5\nwidth 9\nmap\n@@@@@@@@@\n@...@...@\n@.......@\n"
        "@..T@...@\n@@@@@@@@@",
    ),
    "a Pacman layout": ("%%%%%%%\n%P . %%\n%% %o %\n%%%%%%%",),
    "a printed Minigrid": ("WGWGWGWG\nWG  >>WG\nWG  GGWG\nWGWGWGWG",),
    "a map of Policy Reuse": ("-------\n-rrdcc-\n-rr-cc-\n-------",),
    "a grid with solid cells": (
        "wwwwww\nw    w\nw ww w\nwwwwww",
        "######\n#@ $.#\n######",
        "XXXXXX\nX    X\nXXXXXX",
        "██████\n█    █\n██████",
        "@@@@\n@..@\n@@@@",
    ),
    "a layout of gym-classics": ("|    X    |\n|         |\n|XX XXX XX|\n|S   X   G|",),
    "the taxi's map": ("+-------+\n|R: | :G|\n| : : : |\n| | : | |\n+-------+",),
    "a map of FrozenLake": (
        '["SFFF", "FHFH", "FFFH", "HFFG"]',
        "['SFF',\n 'FHF',\n 'FFG']",
        "SFFF\nFHFH\nFFFG",
    ),
    "a list of transitions": (
        "1 N 1 1.0\n1 E 2 0.9\n1 E 1 0.1",
        "0,1,2,0.9\n0,1,0,0.1\n",
    ),
    "an occupancy grid": (
        "1,1,1,1\n1,0,0,1\n1,0,2,1\n1,1,1,1",
        "1111\n1001\n1111",
        "1 1 1\n1 0 1\n1 1 1",
        "P2\n3 2\n255\n0 0 0\n0 255 0",
    ),
    "a map that begins with its size": ("3 4\nW.E.\n....\n..S.",),
    "data, JSON or XML": (
        '{"width": 3, "layers": []}',
        '<?xml version="1.0"?>\n<map></map>',
        "[[1, 1], [1, 0]]",
    ),
    "text without a drawing": ("hello", "See the building on page one.\nIt is nice."),
}

# Ours, or nearly: the message names the place in the text as an editor counts.
NEARLY = {
    "one cell": (
        "+--+\n|* |\n+--+",
        "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or more; "
        "got 3 rows and 4 columns",
    ),
    "capitals": (
        OURS.replace("*", "G").replace("d", "D"),
        "row 4, column 2: unknown character 'G'; here stands a cell: "
        "'.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "fenced, indented and wrong": (
        "```\n\n  # mine\n  " + OURS.replace("*", "x").replace("\n", "\n  ") + "\n```",
        "row 7, column 4: unknown character 'x'; here stands a cell: "
        "'.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "comment within": (
        OURS.replace("\n|. .", "\n# the corridor\n|. ."),
        "row 6, column 10: this line has 14 characters, the first 9; "
        "make all lines equally long",
    ),
    "a tab of no size": (
        OURS.replace("|   |   |", "|\t|\t |"),
        "row 2, column 2: a tab, of which nobody knows how wide it is; "
        "write blanks instead",
    ),
    "tabs of two sizes": (  # with stops at 4 or at 6, the goals are other cells
        "+-----------+\n|\t* * *\t|\n+-----------+",
        "row 2, column 2: a tab, of which nobody knows how wide it is; "
        "write blanks instead",
    ),
    "a wide maze without a goal": (
        "+---+---+\n| S     |\n+   +---+\n|       |\n+---+---+",
        "the map has no goal; put '*' in a cell of a room",
    ),
    "a wide maze with a closed cell": (
        "# mine\n+---+---+---+\n| *     |   |\n+---+---+---+",
        "row 3, column 11: this region cannot be reached from the rest of the "
        "building; put a door in one of its walls",
    ),
    "a wide maze with a strange letter": (
        "+---+---+\n| G   x |\n+---+---+",
        "row 2, column 7: unknown character 'x'; here stands a cell: "
        "'.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "two rooms, or two cells of 5 x 5": (
        "+-----+-----+\n|           |\n|           |\n|  *     *  |\n|           |\n"
        "|           |\n+-----+-----+",
        "row 1, column 7: here no walls meet, as if cells were 5 x 5 characters; "
        "write '-', or one character a cell",
    ),
}

TEXTS = [
    *HARMLESS.values(),
    *(text for text, _ in LARGER_CELLS.values()),
    *(text for texts in NAMED.values() for text in texts),
    *(text for text, _ in NEARLY.values()),
]
