"""Objects below one address of an object store (``s3://bucket/folder``), where there is no renaming.

Each object is written whole or not at all. What must not be lost between two writers is written under the
condition that the object is absent, or is still the one that was read. Keys come from the environment only.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tire_pipeline.errors import DomainError
from tire_pipeline.files.atomic import check_now

DELETED_TOGETHER = 1000
"""So many objects S3 deletes at a time."""
_WORDS_OF_CONFLICT = ("PreconditionFailed", "pre-conditions", "ConditionalRequestConflict")


class ConflictError(Exception):
    """The object is not the one that was read: another run has written it."""


class UnreachableError(DomainError):
    """The store does not answer as it should: that says nothing about any one object."""


@dataclass(frozen=True)
class Listed:
    """What a store tells of an object without reading it.

    Attributes
    ----------
    size : int
        Bytes.
    stamp : str
        Changes with the content.
    written : float
        s since 1970, by the store's clock.
    """

    size: int
    stamp: str
    written: float


def is_remote(path: object) -> bool:
    """Whether a path is an address of an object store rather than a local path."""
    text = str(path)
    return "://" in text and not text.startswith("file://")


def no_place(name: str) -> str:
    """Why no file below a folder could be called as an object is; empty if one could.

    As the path of a file such a name would lead out of its folder, or to the file of another object.

    Examples
    --------
    >>> no_place("/etc/a.tir")
    'its name holds an empty part: no file below a folder is called so'
    """
    if "" in name.split("/"):
        return "its name holds an empty part: no file below a folder is called so"
    return ""


def refuse_keys(address: str) -> None:
    """Raise if keys stand before the bucket; the error does not repeat them.

    A secret key may hold ``/``, so the ``@`` behind it does not always stand before the first one. No bucket
    has a ``:`` in its name; an access point (``arn:aws:s3:...``) has.

    Parameters
    ----------
    address : str
        A local path holds none.

    Raises
    ------
    DomainError

    Examples
    --------
    >>> refuse_keys("s3://bucket/a@b:c"), refuse_keys("s3://arn:aws:s3:us-east-1:123:accesspoint/tires")
    (None, None)
    """
    protocol, _, rest = address.partition("://")
    bucket = rest.split("/", 1)[0]
    if is_remote(address) and ("@" in bucket or (":" in bucket and not bucket.startswith("arn:"))):
        raise DomainError(
            "an address must not contain keys",
            where=f"{protocol}://...",
            todo="give them in the environment (docs/how-to/cluster.md)",
        )


class Objects:
    """The objects below an address.

    Parameters
    ----------
    address : str
        ``s3://bucket/folder``.

    Raises
    ------
    DomainError
        Keys stand in the address, or what is needed to reach it is not installed.
    """

    def __init__(self, address: str) -> None:
        refuse_keys(address)
        protocol, _, rest = address.partition("://")
        import fsspec

        try:
            self._fs: Any = fsspec.filesystem(protocol, use_listings_cache=False)
        except ImportError as error:
            raise DomainError(
                f"what is needed for {protocol}:// is not installed",
                where=address,
                todo='pip install -e ".[s3]"',
            ) from error
        self.address = f"{protocol}://{rest.strip('/')}"
        self.root = rest.strip("/")

    def __str__(self) -> str:
        return self.address

    def below(self, name: str) -> Objects:
        """The objects below ``address/name``."""
        return Objects(f"{self.address}/{name}")

    def _key(self, name: str) -> str:
        return f"{self.root}/{name}" if name and self.root else self.root or name

    def read(self, name: str, most: int | None = None) -> bytes:
        """The content of an object, or so many bytes of its beginning.

        Raises
        ------
        FileNotFoundError
        """
        with self._plain_errors(name):
            try:
                return bytes(self._fs.cat_file(self._key(name), start=None if most is None else 0, end=most))
            except OSError as error:
                if not _of_nothing(error):
                    raise
                return b""

    def read_many(self, names: Iterable[str], most: int) -> dict[str, bytes | OSError]:
        """So many bytes of the beginning of each object, many at once; or why that one cannot be read.

        Raises
        ------
        UnreachableError
            The store does not answer.
        """
        wanted = list(names)
        with self._plain_errors(""):
            keys = [self._key(name) for name in wanted]
            ends = [most] * len(keys)
            found = self._fs.cat_ranges(keys, [0] * len(keys), ends, on_error="return") if keys else []
            found = [b"" if _of_nothing(each) else each for each in found]
            for each in found:
                if isinstance(each, Exception) and not isinstance(each, FileNotFoundError | PermissionError):
                    raise each
        return dict(zip(wanted, found, strict=True))

    def read_stamped(self, name: str) -> tuple[bytes, str]:
        """The content and the stamp of that very content, for :meth:`replace`.

        Raises
        ------
        FileNotFoundError
        """
        with self._plain_errors(name):
            bucket, _, key = self._key(name).partition("/")
            found = self._fs.call_s3("head_object", Bucket=bucket, Key=key)
            content = bytes(self._fs.cat_file(self._key(name)))
            again = self._fs.call_s3("head_object", Bucket=bucket, Key=key)
            if found["ETag"] != again["ETag"]:
                return self.read_stamped(name)
            return content, str(found["ETag"])

    def write(self, name: str, content: bytes) -> None:
        """Put an object in place, whatever was there."""
        check_now()
        with self._plain_errors(name, bucket_only=True):
            self._fs.pipe_file(self._key(name), content)

    def write_file(self, name: str, path: Path) -> None:
        """Put an object in place with the content of a local file, which is not read into memory at once."""
        check_now()
        with self._plain_errors(name, bucket_only=True):
            self._fs.put_file(str(path), self._key(name))

    def write_many(self, contents: Mapping[str, bytes]) -> None:
        """Put objects in place, many at once; a kill leaves any of them."""
        check_now()
        with self._plain_errors("", bucket_only=True):
            self._fs.pipe({self._key(name): content for name, content in contents.items()})

    def create(self, name: str, content: bytes) -> None:
        """Put an object in place that is not there yet.

        Raises
        ------
        ConflictError
            It is there.
        """
        with self._plain_errors(name, bucket_only=True):
            try:
                self._fs.pipe_file(self._key(name), content, mode="create")
            except FileExistsError as error:
                raise ConflictError(name) from error

    def replace(self, name: str, content: bytes, stamp: str | None) -> None:
        """Put an object in place of the one that was read; with no stamp, where there was none.

        Raises
        ------
        ConflictError
            Another one is there.
        """
        check_now()
        if stamp is None:
            self.create(name, content)
            return
        bucket, _, key = self._key(name).partition("/")
        with self._plain_errors(name, bucket_only=True):
            try:
                self._fs.call_s3("put_object", Bucket=bucket, Key=key, Body=content, IfMatch=stamp)
            except OSError as error:
                if any(word in str(error) for word in _WORDS_OF_CONFLICT):
                    raise ConflictError(name) from error
                raise

    def exists(self, name: str) -> bool:
        """Whether an object of this name is there."""
        with self._plain_errors(name):
            return bool(self._fs.isfile(self._key(name)))

    def glob(self, pattern: str) -> list[str]:
        """Names that match a pattern such as ``model.npz/*/model.npz``."""
        with self._plain_errors(pattern):
            start = len(self.root) + 1 if self.root else 0
            return [path[start:] for path in self._fs.glob(self._key(pattern))]

    def listing(self, under: str = "") -> dict[str, Listed]:
        """Name -> what is told of it, of all objects below ``address/under``, sorted."""
        with self._plain_errors(under):
            try:
                found = self._fs.find(self._key(under), detail=True)
            except FileNotFoundError:
                return {}
        start = len(self.root) + 1 if self.root else 0
        return {
            path[start:]: Listed(
                int(info["size"]), str(info.get("ETag", info["size"])), info["LastModified"].timestamp()
            )
            for path, info in sorted(found.items())
        }

    def stamps(self, under: str = "") -> dict[str, str]:
        """Name -> stamp (changes with the content) of all objects below ``address/under``."""
        return {name: each.stamp for name, each in self.listing(under).items()}

    def names(self, under: str = "") -> list[str]:
        """Names of all objects below ``address/under``, sorted."""
        return list(self.listing(under))

    def is_empty(self) -> bool:
        """Whether there is nothing below the address; asks for one object only."""
        bucket, _, key = self.root.partition("/")
        with self._plain_errors("", bucket_only=True):
            prefix = f"{key}/" if key else ""
            found = self._fs.call_s3("list_objects_v2", Bucket=bucket, Prefix=prefix, MaxKeys=1)
            return not found.get("Contents")

    def delete(self, names: Iterable[str]) -> None:
        """Take objects away; those that are gone already do not matter.

        Names are taken as they are: s3fs would take ``run[1].html`` or ``a*.tir`` for a pattern, and delete
        what fits it. It would not tell either what the store refuses to delete.

        Raises
        ------
        DomainError
            The store has not deleted one of them.
        """
        keys = [{"Key": self._key(name).partition("/")[2]} for name in names]
        bucket = self.root.partition("/")[0]
        check_now()
        for start in range(0, len(keys), DELETED_TOGETHER):
            asked = {"Objects": keys[start : start + DELETED_TOGETHER], "Quiet": True}
            with contextlib.suppress(FileNotFoundError), self._plain_errors(""):
                refused = self._fs.call_s3("delete_objects", Bucket=bucket, Delete=asked).get("Errors")
                if refused:
                    raise DomainError(
                        f"the object store did not delete this ({refused[0]['Code']})",
                        where=f"s3://{bucket}/{refused[0]['Key']}",
                        todo="allow deleting below the address of the data, then run again",
                    )

    @contextlib.contextmanager
    def _plain_errors(self, name: str, *, bucket_only: bool = False) -> Iterator[None]:
        """Whatever the library raises, in one sentence without addresses of requests or keys."""
        try:
            yield
        except (ConflictError, DomainError):
            raise
        except FileNotFoundError:
            if not bucket_only:
                raise
            todo = "make it, or correct the address"
            raise DomainError("there is no such bucket", where=self.address, todo=todo) from None
        except Exception as error:
            kind = type(error).__name__
            told = DomainError if isinstance(error, PermissionError) else UnreachableError
            raise told(
                f"the object store did not do what was asked ({kind})",
                where=f"{self.address}/{name}",
                todo="are bucket, permissions, keys and endpoint in the environment right?",
            ) from None


def _of_nothing(found: object) -> bool:
    """Whether it is the error that the beginning of an empty object was asked for."""
    told = getattr(getattr(found, "__cause__", None), "response", None) or {}
    return bool(told.get("Error", {}).get("Code") == "InvalidRange")
