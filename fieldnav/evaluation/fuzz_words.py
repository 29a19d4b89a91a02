"""What people and programs write where a settings file or a journal wants a plain value."""

NUMBERS = (
    *("0", "-1", "1e9", "-1e308", "1e400", ".inf", "-.inf", ".nan", "NaN", "Infinity", "1_000", "0x7f"),
    *("0o17", "0b1", "1:30", "5e-4", "+.5", "2.5", "1.", "12e03", "1e", "1e-320", "-0", "190:20:30"),
    *("9" * 30, "9" * 5000, "-" + "9" * 39, "1" + "_1" * 15, "99999999999999999999", "-9223372036854775809"),
)
OTHERS = (
    *("true", "no", "~", "null", "[]", "{}", "[1, 2", "{a: 1", "'", '"', '"\\ud800"', '"\\0"', "'a\n b'"),
    *('"a\\nb"', "2024-01-01", "2024-13-45", "=", "<<", "? a", "- a", "|", ">", "@", "`", "%", "!", "&a 1"),
    *("*a", "# none", ": :", "[[[[[]]]]]", "{a: {b: {c: {d: {}}}}}", "\x1b[31mred", "\u202etxet", "\ufeff"),
    *("日本語", "x" * 3000, "../../etc", "/dev/zero", "a b", "[1, two, 3.0]", "{rear_right: 1}"),
    *(
        "[.nan, .inf]",
        '"\\U0010ffff"',
        "\x85",
        "\u2028",
        '"\\u2028"',
        '"\\r"',
        '"\\t"',
        "[" + "1," * 500 + "1]",
    ),
)
NAMES = ("x", "", "1", "~", "true", "ключ", "[a]", "a\tb", '"a\\nb"', "x" * 5000, "<<", "? ")
CANARY = "fieldnav.evaluation.fuzz_files.code_has_run"
TAGS = (
    f"!!python/object/apply:{CANARY} []",
    f"!!python/object/new:{CANARY} []",
    f"!!python/name:{CANARY}",
    "!!python/module:antigravity",
    "!!python/object:fieldnav.settings.robot.Robot {}",
    *("!!binary aGVsbG8=", "!!set {a, b}", "!!omap [a: 1]", "!!float x", "!!int '9'", "!local 1"),
    *("!!timestamp 2001-01-01", "!<tag:yaml.org,2002:python/tuple> [1]", "&a 1", "*a", "&a [*a]", "{<<: *a}"),
)
"""Would call, import or share something if they were obeyed."""
BOMB = "a: &a [x, x]\n" + "".join(
    f"{after}: &{after} [*{before}, *{before}, *{before}]\n"
    for before, after in zip("abcdefghijklmnop", "bcdefghijklmnopq", strict=True)
)
"""Grows to millions of values where aliases are followed."""
PIECES = ("---\n", "...\n", "%YAML 9.9\n---\n", "\r", "\0", "\ud800", "k: v\n" * 3000, "\n\n", "\t", BOMB)
DEPTHS = (1, 19, 21, 500, 4000)
BRACKETS = (("[", "]"), ("{a: ", "}"), ("- ", ""), ('{"a": ', "}"))
ENCODINGS = ("utf-16", "utf-16-le", "utf-32", "utf-8-sig", "cp037", "latin-1")
