"""Options that several commands of tools/bench have."""


def add_repetitions(parser, words, usual):
    """How often all is measured; words: of what."""
    parser.add_argument("--repetitions", metavar="N", type=int, default=usual, help=f"{words}; default: %(default)s")


def add_first(parser, what, rows, words=""):
    """Only the first of the rows that a command measures; what: their plural; words: what is to be known of the others."""
    parser.add_argument(f"--{what}", metavar="N", type=int, default=len(rows), choices=range(1, len(rows) + 1),
                        help=f"only the first N of the {what}{words}")
