"""Files: texts that are read; of a file that is written the ending of the name chooses the format, and it is written atomically."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from .errors import Error, RangeError


def read(path: str | os.PathLike[str], refusal: type[Error]) -> str:
    """Return the text of a file; the refusal is raised where it is not UTF-8."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except UnicodeDecodeError as fault:
        name = os.fspath(path)
        raise refusal(f"{name} is no text in UTF-8, from byte {fault.start} on", "path", str(name)) from fault


def ending(path: Path, accepted: Sequence[str], key: str = "path") -> str:
    """Return the ending of a file's name in small letters, one of those accepted.

    Raises
    ------
    RangeError
        When it is another one, or none.

    """
    found = path.suffix.lower()
    if found not in accepted:
        named = accepted[0] if len(accepted) == 1 else f"{', '.join(accepted[:-1])} or {accepted[-1]}"
        raise RangeError(f"{key} is {path.name}, but accepted is a name that ends in {named}", key, path.name)
    return found


def write(path: Path, parts: Iterable[bytes]) -> None:
    """Write a file atomically: it is there with all its parts, or as it was."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with draft.open("wb") as out:
            out.writelines(parts)
            out.flush()
            os.fsync(out.fileno())
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def parquet(table: Any) -> bytes:
    """Return a pyarrow Table as a Parquet file."""
    import pyarrow.parquet as pq

    out = BytesIO()
    pq.write_table(table, out)
    return out.getvalue()
