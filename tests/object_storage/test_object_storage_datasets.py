"""Datasets in a bucket: whole or not at all, and never over what another run has written."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
from functools import partial

import pytest
from kedro.io import DatasetError, Version
from moto_keys import KEY

from tire_pipeline.datasets import (
    ComputedFolderDataset,
    HtmlPageDataset,
    IngestStoreDataset,
    MadeFilesDataset,
    RecordingFolderDataset,
    ReleaseDataset,
    StateDataset,
    TextFolderDataset,
    TirFolderDataset,
)
from tire_pipeline.errors import DomainError, RecordingError, TirError
from tire_pipeline.files.objects import ConflictError, Objects
from tire_pipeline.retraining import Judged, Manifest, Store, difference, judge
from tire_pipeline.retraining.release.record import ModelRegistry, Release
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.runs import LostTicketError, ObjectTicket, OtherRunsOnObjects, take_turn
from tire_pipeline.tire_table import from_models


def _table(*files: str) -> Partition:
    frame = from_models([]).reindex(range(len(files)))
    return Partition.of(frame.assign(file=list(files), category="A", version="5.2", date="", PCY1=1.3))


@pytest.fixture
def folder(bucket):
    return Objects(f"{bucket}/data")


def test_one_of_two_writers_wins(folder):
    folder.create("note", b"1")
    with pytest.raises(ConflictError):
        folder.create("note", b"2")
    content, stamp = folder.read_stamped("note")
    folder.replace("note", b"3", stamp)
    with pytest.raises(ConflictError):
        folder.replace("note", b"4", stamp)
    with pytest.raises(ConflictError):
        folder.replace("note", b"5", None)
    assert (content, folder.read("note")) == (b"1", b"3")


def test_keys_are_neither_taken_from_an_address_nor_told(bucket, monkeypatch):
    with pytest.raises(DomainError) as found:
        Objects("s3://KEY:sEcReT@bucket/data")
    assert "sEcReT" not in str(found.value)
    monkeypatch.setenv("AWS_ENDPOINT_URL", "http://127.0.0.1:9")
    monkeypatch.setenv("AWS_MAX_ATTEMPTS", "1")
    import s3fs

    s3fs.S3FileSystem.clear_instance_cache()
    with pytest.raises(DomainError, match="environment right") as found:
        Objects(f"{bucket}/data").read("x")
    assert os.environ["AWS_SECRET_ACCESS_KEY"] not in str(found.value)
    assert found.value.__cause__ is None
    s3fs.S3FileSystem.clear_instance_cache()


def test_a_name_that_reads_as_a_pattern_deletes_that_object_alone(folder):
    kept = ["ab.tir", "run1.html", "x/y.tir"]
    gone = ["a*.tir", "run[1].html", "**", "x/?.tir"]
    folder.write_many(dict.fromkeys([*kept, *gone], b"x"))
    folder.delete([*gone, "absent*"])
    assert folder.names() == kept


def test_more_objects_than_the_store_deletes_at_a_time_are_deleted(folder, monkeypatch):
    monkeypatch.setattr("tire_pipeline.files.objects.DELETED_TOGETHER", 2)
    folder.write_many(dict.fromkeys("abcde", b"x"))
    folder.delete("abcde")
    assert folder.names() == []


def test_what_the_store_does_not_delete_is_told(folder, monkeypatch):
    class Refusing:
        def call_s3(self, *_, Delete, **__):
            return {"Errors": [{"Key": each["Key"], "Code": "AccessDenied"} for each in Delete["Objects"]]}

    monkeypatch.setattr("fsspec.filesystem", lambda *_, **__: Refusing())
    with pytest.raises(DomainError, match=r"did not delete this \(AccessDenied\)") as found:
        Objects(str(folder)).delete(["07/x.csv/v1/x.csv"])
    assert found.value.where == f"{folder}/07/x.csv/v1/x.csv"


@pytest.mark.parametrize("dataset", [Objects, lambda path: TirFolderDataset(path=path)])
@pytest.mark.parametrize("secret", ["seCret", "seC/ret", "seC/r@t", "/seCret"])
def test_a_secret_key_with_a_slash_is_not_told_either(dataset, secret):
    with pytest.raises(DomainError, match="must not contain keys") as found:
        dataset(f"s3://{KEY}:{secret}@bucket/tires")
    assert "seC" not in str(found.value)
    assert KEY not in str(found.value)


def test_no_folder_called_s3_is_made_here(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    HtmlPageDataset(filepath=f"{folder}/page.html").save("<p>")
    StateDataset(filepath=f"{folder}/model.npz").save({"a": 1})
    TextFolderDataset(path=f"{folder}/texts").save({"a/b.txt": "text"})
    assert list(tmp_path.iterdir()) == []
    assert HtmlPageDataset(filepath=f"{folder}/page.html").load() == "<p>"
    assert StateDataset(filepath=f"{folder}/model.npz").load() == {"a": 1}
    assert TextFolderDataset(path=f"{folder}/texts").load() == {"a/b.txt": b"text"}
    assert MadeFilesDataset(path=f"{folder}/texts").load() == ["a/b.txt"]


def test_the_newest_version_of_a_model_is_loaded(folder):
    for number in (1, 2):
        version = Version(None, f"2026-01-0{number}T00.00.00.000Z")
        StateDataset(filepath=f"{folder}/model.npz", version=version).save({"number": number})
    assert StateDataset(filepath=f"{folder}/model.npz", version=Version(None, None)).load() == {"number": 2}


def test_a_folder_of_texts_is_replaced_and_a_users_folder_is_not(folder):
    texts = TextFolderDataset(path=f"{folder}/texts", suffix=".txt")
    texts.save({"a.txt": "1", "b.txt": b"2"})
    texts.save({"b.txt": lambda: b"3"})
    assert texts.load() == {"b.txt": b"3"}
    assert folder.names("texts") == ["texts/.made_by_tire_pipeline", "texts/b.txt"]
    kept = TextFolderDataset(path=f"{folder}/texts", suffix=".txt", keep=True)
    kept.save({"c.txt": "4"})
    assert kept.load() == {"b.txt": b"3", "c.txt": b"4"}
    folder.write("own/mine.txt", b"mine")
    with pytest.raises(DatasetError, match="not made by this project"):
        TextFolderDataset(path=f"{folder}/own").save({"a.txt": "1"})
    assert folder.names("own") == ["own/mine.txt"]


def test_texts_of_any_name_come_back_and_go(folder):
    names = ["a\u2028b.tir", "c\x85d.tir", "run[1].tir", "run1.tir", "x*.tir", "%41 +&#.tir", "\u202e.tir"]
    texts = TextFolderDataset(path=f"{folder}/texts")
    texts.save(dict.fromkeys(names, "text"))
    assert dict(texts.load()) == dict.fromkeys(names, b"text")
    texts.save(dict.fromkeys(["run1.tir", "xy.tir"], "new"))
    assert dict(texts.load()) == {"run1.tir": b"new", "xy.tir": b"new"}
    assert len(folder.names("texts")) == 3


def test_a_folder_of_texts_whose_write_was_killed_is_not_used(folder):
    texts = TextFolderDataset(path=f"{folder}/texts")
    texts.save({"a.txt": "1", "b.txt": "2"})

    def killed() -> bytes:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        texts.save({"a.txt": "3", "b.txt": killed})
    with pytest.raises(DatasetError, match="stopped before it was done"):
        texts.load()
    texts.save({"a.txt": "5"})
    assert texts.load() == {"a.txt": b"5"}
    folder.write("texts/a.txt", b"changed")
    with pytest.raises(DomainError, match="changed since"):
        texts.load()["a.txt"]


def test_what_is_computed_is_not_computed_again(folder, tmp_path):
    def count(name: str) -> bytes:
        with (tmp_path / name).open("a") as file:
            file.write("x")
        return name.encode()

    dataset = ComputedFolderDataset(path=f"{folder}/out")
    dataset.save({"k/a": partial(count, "a")})
    dataset.save({"k/a": partial(count, "a"), "k/b": partial(count, "b")})
    reads = pickle.loads(pickle.dumps(dataset.load()))  # workers read, too
    assert {name: read() for name, read in reads.items()} == {"k/a": b"a", "k/b": b"b"}
    assert [(tmp_path / name).read_text() for name in "ab"] == ["x", "x"]


def test_the_store_of_files_counts_when_its_manifest_does(folder):
    dataset = IngestStoreDataset(path=f"{folder}/ingested")
    assert len(dataset.load().table) == 0
    one = Store(Manifest(sequence=1), _table("a"))
    dataset.save(one)
    assert dataset.load().table["file"].tolist() == ["a"]
    with pytest.raises(DatasetError, match="another run has stored"):
        dataset.save(one)  # began before the first was stored
    before = dataset.load()
    folder.write("ingested/part-000009-stray.parquet", b"of a run that was killed")
    assert dataset.load().table["file"].tolist() == ["a"]
    dataset.save(Store(Manifest(revision=before.manifest.revision, sequence=2), _table("b")))
    assert dataset.load().table["file"].tolist() == ["b"]
    assert len(folder.names("ingested")) == 2


def test_a_store_that_changes_during_the_write_is_left_as_it_is(folder, monkeypatch):
    dataset = IngestStoreDataset(path=f"{folder}/ingested")
    dataset.save(Store(Manifest(sequence=1), _table("a")))
    before = dataset.load()
    write = Objects.write

    def meanwhile(self, name, content):
        write(self, name, content)
        if name.startswith("part-"):
            monkeypatch.setattr(Objects, "write", write)
            own = IngestStoreDataset(path=f"{folder}/ingested")
            manifest = Manifest(revision=before.manifest.revision, sequence=2)
            own.save(Store(manifest, _table("other")))

    monkeypatch.setattr(Objects, "write", meanwhile)
    manifest = Manifest(revision=before.manifest.revision, sequence=2)
    with pytest.raises(DatasetError, match="another run has stored its results in the meantime"):
        dataset.save(Store(manifest, _table("mine")))
    assert dataset.load().table["file"].tolist() == ["other"]


def test_the_record_of_releases_is_replaced_by_one_run_only(folder):
    dataset = ReleaseDataset(path=f"{folder}/released")
    assert dataset.load() == ModelRegistry()
    refused = partial(judge, Release(), better=False, time="now", figures={})
    judged = Judged(digest="d", settings="s", sequence=1, split="x")
    first = refused("m", judged)
    dataset.save(ModelRegistry(first))
    assert dataset.load().release == Release.from_dict(first.to_dict())
    with pytest.raises(DatasetError, match="another run has stored"):
        dataset.save(ModelRegistry(refused("other", judged)))


def test_files_of_a_bucket_are_read_with_their_sidecars(folder, tmp_path):
    from pathlib import Path

    example = Path(__file__).resolve().parents[2] / "examples" / "tire.tir"
    folder.write("A/one.tir", example.read_bytes())
    folder.write("A/.hidden.tir", b"no")
    folder.write("A/bad.TIR", b"no tire")
    loaders = TirFolderDataset(path=str(folder)).load()
    assert list(loaders) == ["A/bad.TIR", "A/one.tir"]
    assert loaders["A/one.tir"]().path == f"{folder}/A/one.tir"
    before = loaders["A/one.tir"].fingerprint()
    assert TirFolderDataset(path=str(folder)).load()["A/one.tir"].fingerprint() == before
    folder.write("A/one.tir", example.read_bytes() + b"\n")
    assert TirFolderDataset(path=str(folder)).load()["A/one.tir"].fingerprint() != before


def test_a_recording_of_a_bucket_finds_its_tire(folder):
    from pathlib import Path

    examples = Path(__file__).resolve().parents[2] / "examples"
    folder.write("rig/model.tir", (examples / "tire.tir").read_bytes())
    folder.write("rig/run.csv", (examples / "rig_run.csv").read_bytes())
    folder.write("alone/run.csv", (examples / "rig_run.csv").read_bytes())
    loaders = RecordingFolderDataset(path=str(folder)).load()
    tire, recording = loaders["rig/run.csv"]()
    assert tire.path == f"{folder}/rig/model.tir"
    assert len(recording) > 100
    with pytest.raises(Exception, match=f"{folder}/alone/run.csv: no .tir file"):
        loaders["alone/run.csv"]()


def test_a_name_that_leads_out_of_its_folder_writes_nothing_here_and_is_told(folder, tmp_path):
    outside = tmp_path / "outside"
    outside.mkdir()
    folder.write("rig/run.csv", b"time,slip_angle\n0,0.1\n")
    folder.write(f"{outside}/evil.csv", b"time,slip_angle\n0,0.1\n")  # begins with a slash
    folder.write("rig//run.csv", b"time,slip_angle\n0,0.2\n")
    loaders = RecordingFolderDataset(path=str(folder)).load()
    assert len(loaders) == 3
    for name, load in loaders.items():
        said = "no .tir file lies beside" if name == "rig/run.csv" else "its name holds an empty part"
        with pytest.raises(RecordingError, match=said):
            load()
    assert not list(outside.iterdir())


def test_a_tir_object_whose_name_is_no_path_is_told(folder):
    for name in ("/A/one.tir", "A//one.tir", "A/one.tir"):
        folder.write(name, b"no tire")
    loaders = TirFolderDataset(path=str(folder)).load()
    said = {}
    for name, load in loaders.items():
        with pytest.raises(TirError) as raised:
            load()
        said[name] = "empty part" in str(raised.value)
    assert said == {"/A/one.tir": True, "A//one.tir": True, "A/one.tir": False}
    found = difference(folder, Manifest())
    assert set(found.added) == {"A/one.tir"}
    assert set(found.aside) == {"/A/one.tir", "A//one.tir"}


def test_a_recording_of_a_bucket_that_is_too_large_is_not_fetched(folder, monkeypatch):
    monkeypatch.setattr("tire_pipeline.recordings.readers.limits.most_bytes", lambda: 10.0)
    folder.write("rig/run.csv", b"time,slip_angle\n0,0.1\n")
    (load,) = RecordingFolderDataset(path=str(folder)).load().values()
    monkeypatch.setattr(Objects, "read", lambda *_: pytest.fail("it is fetched"))
    with pytest.raises(RecordingError, match="too many for the memory"):
        load()


class OtherRun:
    """A run in a process of its own, with a ticket; it writes an object when it is told to."""

    SCRIPT = """
import sys
from tire_pipeline.files.objects import Objects
from tire_pipeline.runs import ObjectTicket

data = Objects(sys.argv[1])
ticket = ObjectTicket.draw(data, run="v1", places=sys.argv[2:], beat_seconds=0.05)
print(ticket.note.number, flush=True)
for line in sys.stdin:
    data.write(line.strip(), b"the write that was under way")
    print("written", flush=True)
"""

    def __init__(self, data: Objects, *places: str) -> None:
        command = [sys.executable, "-c", self.SCRIPT, str(data), *places]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline() == "1\n"

    def send(self, number: signal.Signals) -> None:
        self.process.send_signal(number)

    def told_to_write(self, name: str) -> None:
        self.process.stdin.write(f"{name}\n")
        self.process.stdin.flush()

    def has_written(self) -> None:
        assert self.process.stdout.readline() == "written\n"

    def __enter__(self) -> OtherRun:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.communicate()


def test_a_killed_runs_results_go_and_a_living_run_is_named(folder):
    place = "07/x.csv/v1"
    folder.write(f"{place}/x.csv", b"half")
    folder.write("07/x.csv/v0/x.csv", b"whole")
    with OtherRun(folder, place, "../other") as other:
        living = ObjectTicket.draw(folder, run="v2", beat_seconds=0.05)
        with pytest.raises(DomainError, match="is alive"):
            take_turn(living, others=OtherRunsOnObjects(living, 5.0))
        other.send(signal.SIGKILL)
        take_turn(living, others=OtherRunsOnObjects(living, 0.5), wait_seconds=60)
    assert folder.names("07") == ["07/x.csv/v0/x.csv"]
    living.check()
    living.end()


def test_a_run_that_was_declared_dead_and_wakes_is_cleared_again(folder):
    place = "07/x.csv/v1"
    with OtherRun(folder, place) as slept:
        slept.send(signal.SIGSTOP)
        second = ObjectTicket.draw(folder, run="v2", beat_seconds=0.05)
        take_turn(second, others=OtherRunsOnObjects(second, 0.5))
        slept.told_to_write(f"{place}/x.csv")
        slept.send(signal.SIGCONT)
        slept.has_written()
        second.end()
        third = ObjectTicket.draw(folder, run="v3", beat_seconds=0.05)
        take_turn(third, others=OtherRunsOnObjects(third, 0.5))
    assert folder.names("07") == []
    third.end()


def test_a_run_that_was_declared_dead_is_told_so(folder):
    first = ObjectTicket.draw(folder, run="v1")
    first.check()
    second = ObjectTicket.draw(folder, run="v2")
    OtherRunsOnObjects(second, 0.5).declare_dead(first.note)
    with pytest.raises(LostTicketError):
        first.check()
    second.check()
    first.end()
    second.end()


def test_a_run_that_was_declared_dead_is_told_so_when_others_have_forgotten_it(folder, monkeypatch):
    monkeypatch.setattr("tire_pipeline.runs.on_objects.KEPT_TICKETS", 1)
    first = ObjectTicket.draw(folder, run="v1")
    for number in range(4):
        later = ObjectTicket.draw(folder, run=f"later{number}")
        if number == 0:
            OtherRunsOnObjects(later, 0.5).declare_dead(first.note)
        later.end()
    assert not folder.exists(".runs/000001.over")
    with pytest.raises(LostTicketError):
        first.check()
    first.end()
