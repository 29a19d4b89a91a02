"""Text of a file as a message may show it: on one line, and with nothing that moves a terminal's cursor."""


def one_line(text: str) -> str:
    r"""The text with what cannot be printed written out, a line break as \n."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else _written_out(each) for each in text)


def _written_out(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")
