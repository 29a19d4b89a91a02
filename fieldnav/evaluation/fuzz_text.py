"""Files as slips of the keyboard, torn copies and ill will make them, drawn from a seed."""

import re
from collections.abc import Callable, Sequence
from random import Random

from fieldnav.evaluation.fuzz_words import BRACKETS, DEPTHS, ENCODINGS, NAMES, NUMBERS, OTHERS, PIECES, TAGS

ENTRY = re.compile(r'^([\s{,]*(?:- )?"?)([A-Za-z_][\w-]*)("?:\s*)(.*)$')
"""A line with a key: what stands before it, the key, the colon, the value; of YAML and of indented JSON."""
SEVERAL = 0.25
"""Share of the files that are changed more than once; our choice, as are the others here."""
MOST_CHANGES = 3
BYTES_CHANGED = 0.2
MOST_FLIPPED, MOST_JUNK_BYTES = 12, 400
LARGE_LINES = (300, 3000, 12_000)
"""Lines more than a file has; the last of them make it larger than is read."""

Change = Callable[[str, str, str, str], str]


def mutated(text: str, others: Sequence[str], random: Random) -> bytes:
    """The text after a few changes, as it stands in a file; parts of the other texts may get in."""
    for _ in range(random.randint(2, MOST_CHANGES) if random.random() < SEVERAL else 1):
        way = random.choice(_WAYS)
        text = _mixed(text, random.choice(others), random) if way is None else way(text, random)
    if random.random() < BYTES_CHANGED:
        return random.choice((_flipped, _flipped, _junk, _recoded))(text, random)
    return _bytes(text)


def _on_entry(text: str, random: Random, change: Change) -> str:
    """One line that has a key, made anew from its parts."""
    lines = text.split("\n")
    places = [place for place, line in enumerate(lines) if ENTRY.match(line)]
    if places:
        place = random.choice(places)
        lines[place] = ENTRY.sub(lambda found: change(*found.groups()), lines[place])
    return "\n".join(lines)


def _renamed(text: str, random: Random) -> str:
    name = random.choice(NAMES)
    return _on_entry(text, random, lambda before, key, colon, value: f"{before}{name}{colon}{value}")


def _misspelt(text: str, random: Random) -> str:
    def slip(before: str, key: str, colon: str, value: str) -> str:
        place = random.randrange(len(key))
        return (
            f"{before}{key[:place]}{random.choice(('', 'x', key[place] * 2))}{key[place + 1 :]}{colon}{value}"
        )

    return _on_entry(text, random, slip)


def _replaced(text: str, random: Random) -> str:
    odd = random.choice(random.choice((NUMBERS, OTHERS, TAGS))) + random.choice(("", ","))
    return _on_entry(text, random, lambda before, key, colon, _: f"{before}{key}{colon}{odd}")


def _doubled(text: str, random: Random) -> str:
    return _on_entry(text, random, lambda *parts: "\n".join(["".join(parts)] * 2))


def _nested(text: str, random: Random) -> str:
    depth, (opened, closed) = random.choice(DEPTHS), random.choice(BRACKETS)
    deep = opened * depth + closed * random.choice((0, depth))
    return _on_entry(text, random, lambda before, key, colon, _: f"{before}{key}{colon}{deep}")


def _dropped(text: str, random: Random) -> str:
    lines = text.split("\n")
    first = random.randrange(len(lines))
    return "\n".join(lines[:first] + lines[first + random.randint(1, MOST_CHANGES) :])


def _indented(text: str, random: Random) -> str:
    lines = text.split("\n")
    place = random.randrange(len(lines))
    lines[place] = random.choice((" ", "   ", "\t", "- ", "  - ")) + lines[place]
    return "\n".join(lines)


def _swapped(text: str, random: Random) -> str:
    lines = text.split("\n")
    one, other = random.randrange(len(lines)), random.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]
    return "\n".join(lines)


def _cut(text: str, random: Random) -> str:
    return text[: random.randrange(len(text) + 1)]


def _written_in(text: str, random: Random) -> str:
    place = random.randrange(len(text) + 1)
    return text[:place] + random.choice(random.choice((OTHERS, TAGS, PIECES))) + text[place:]


def _lengthened(text: str, random: Random) -> str:
    return text + "".join(f"key{number}: {number}\n" for number in range(random.choice(LARGE_LINES)))


def _mixed(text: str, other: str, random: Random) -> str:
    """Lines of another file in the middle of this one."""
    lines, others = text.split("\n"), other.split("\n")
    place, first = random.randrange(len(lines)), random.randrange(len(others))
    return "\n".join(lines[:place] + others[first : first + random.randint(1, len(others))] + lines[place:])


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _flipped(text: str, random: Random) -> bytes:
    changed = bytearray(_bytes(text) or b"\0")
    for _ in range(random.randint(1, MOST_FLIPPED)):
        changed[random.randrange(len(changed))] ^= 1 << random.randrange(8)
    return bytes(changed)


def _junk(text: str, random: Random) -> bytes:
    content = _bytes(text)
    place = random.choice((0, random.randrange(len(content) + 1)))
    return content[:place] + random.randbytes(random.randint(1, MOST_JUNK_BYTES)) + content[place:]


def _recoded(text: str, random: Random) -> bytes:
    return text.encode(random.choice(ENCODINGS), "replace")


_WAYS: tuple[Callable[[str, Random], str] | None, ...] = (
    *(
        _renamed,
        _misspelt,
        _replaced,
        _replaced,
        _replaced,
        _replaced,
        _doubled,
        _nested,
        _dropped,
        _indented,
    ),
    *(_swapped, _cut, _written_in, _written_in, _lengthened, None),
)
"""None stands for the one that needs another file."""
