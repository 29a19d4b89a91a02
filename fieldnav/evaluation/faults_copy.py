"""A copy of this process does something and tells what came of it; this process is as it was before."""

import os
import pickle
import sys
from collections.abc import Callable
from typing import TypeVar, cast

Result = TypeVar("Result")


class CopyError(Exception):
    """The copy broke off; in one line why."""


def in_a_copy(work: Callable[[], Result]) -> Result:
    """What `work`, done in a forked process, returns; it can be pickled. Raises CopyError.

    Only for a process of one thread: the copy has no other.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        _tell(work, writing)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        told = pipe.read()
    os.waitpid(child, 0)
    if not told:
        raise CopyError("the process died")
    done, result = pickle.loads(told)
    if not done:
        raise CopyError(str(result))
    return cast(Result, result)


def _tell(work: Callable[[], Result], writing: int) -> None:
    """In the copy: nothing of the original's, above all no open file, may be tidied up on the way out."""
    try:
        try:
            told = pickle.dumps((True, work()))
        except BaseException as error:
            frame = sys.exc_info()[2]
            while frame is not None and frame.tb_next is not None:
                frame = frame.tb_next
            where = (
                f" at {os.path.basename(frame.tb_frame.f_code.co_filename)}:{frame.tb_lineno}"
                if frame
                else ""
            )
            told = pickle.dumps((False, f"{type(error).__name__}: {error}{where}"))
        with os.fdopen(writing, "wb") as pipe:
            pipe.write(told)
    finally:
        os._exit(0)
