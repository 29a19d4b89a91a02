"""`fieldnav profiles`: what crops, robots and fields there are, what is in them, whether a file is right."""

from enum import Enum
from typing import Annotated

import typer

from fieldnav.cli.console import FAILED, out, print_error, print_json, print_line
from fieldnav.cli.profile_tables import profile_table
from fieldnav.errors import SettingsError
from fieldnav.settings.documents import parse_mapping, read_text, written
from fieldnav.settings.kinds import Kind, is_path, kind_of_document, kinds_named, names_of
from fieldnav.settings.loading import load

profiles = typer.Typer(
    name="profiles", no_args_is_help=True, help="List, show and check crops, robots and fields."
)


class Choice(Enum):
    """The kinds, as they are typed."""

    CROP = "crop"
    ROBOT = "robot"
    FIELD = "field"

    @property
    def kind(self) -> Kind:
        return Kind[self.name]


KindOption = Annotated[
    Choice | None,
    typer.Option(help="Which kind, where a name stands for several; otherwise it is found out."),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON, for programs.")]


@profiles.command("list")
def list_profiles(
    kind: Annotated[Choice | None, typer.Option(help="Only this kind.")] = None, json: JsonOption = False
) -> None:
    """List the crops, robots and fields that come with fieldnav."""
    kinds = [kind.kind] if kind else list(Kind)
    if json:
        print_json({each.value: names_of(each) for each in kinds})
        return
    console = out()
    for each in kinds:
        console.print(profile_table(each))
        console.print()
    console.print(
        "One in full: fieldnav profiles show NAME. To make your own, save what that prints.", style="dim"
    )


@profiles.command()
def show(
    name: Annotated[str, typer.Argument(help="A name from `profiles list`, or the path of a file.")],
    kind: KindOption = None,
    json: JsonOption = False,
) -> None:
    """Print a crop, robot or field with every default filled in, as YAML to copy and change."""
    first, *others = _kinds_of(name, kind)
    document = load(first, name).model_dump(mode="json")
    if json:
        print_json(document)
        return
    print_line(f"# {first.singular} {name}, every default filled in")
    for other in others:
        print_line(
            f"# A {other.singular} has this name too: fieldnav profiles show {name} --kind {other.singular}"
        )
    print(written(document), end="")


@profiles.command()
def validate(
    files: Annotated[
        list[str], typer.Argument(help="Names or paths of crop, robot or field files.", metavar="FILE...")
    ],
    kind: KindOption = None,
) -> None:
    """Check files before the field does: a line for each, saying what is wrong in it."""
    failed = False
    for name in files:
        try:
            for each in _kinds_of(name, kind):
                load(each, name)
                print_line(f"{name}: a valid {each.singular}")
        except SettingsError as error:
            failed = True
            print_error(str(error))
    if failed:
        raise typer.Exit(FAILED)


def _kinds_of(name: str, choice: Choice | None) -> list[Kind]:
    if choice:
        return [choice.kind]
    if is_path(name):
        return [kind_of_document(parse_mapping(read_text(name), name))]
    return kinds_named(name)
