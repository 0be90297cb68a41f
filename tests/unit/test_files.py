from __future__ import annotations

import errno
import os
import stat

import pytest

from nsode.files import create, write_all, write_binary, write_generated
from support import listing


def test_all_files_appear_with_their_text(tmp_path):
    paths = write_all({"a.h": "one\n", "a.c": "zwei é\n"}, tmp_path / "new" / "folder")
    assert [p.name for p in paths] == ["a.h", "a.c"]
    assert [p.read_bytes() for p in paths] == [b"one\n", "zwei é\n".encode()]
    assert listing(tmp_path / "new" / "folder") == ["a.c", "a.h"]


def test_a_text_that_cannot_be_written_leaves_the_old_files_alone(tmp_path):
    (tmp_path / "a.h").write_text("old")
    with pytest.raises(UnicodeEncodeError):
        write_all({"a.h": "new", "a.c": "\ud800"}, tmp_path)
    assert (tmp_path / "a.h").read_text() == "old"
    assert listing(tmp_path) == ["a.h"]


def test_a_folder_in_the_place_of_a_file_stops_every_file(tmp_path):
    (tmp_path / "a.c").mkdir()
    with pytest.raises(IsADirectoryError):
        write_all({"a.h": "new", "a.c": "new"}, tmp_path)
    assert listing(tmp_path) == ["a.c"]


@pytest.mark.parametrize("name", ["", ".", "..", "../a.c", "/a.c", "b/a.c", "a\0.c"])
def test_a_name_never_leads_out_of_the_folder(tmp_path, name):
    with pytest.raises(ValueError, match="plain name"):
        write_all({name: "text"}, tmp_path / "inside")
    assert listing(tmp_path) == []


def test_a_link_is_replaced_and_not_followed(tmp_path):
    outside = tmp_path / "outside"
    outside.write_text("precious")
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "a.c").symlink_to(outside)
    write_all({"a.c": "new"}, folder)
    assert outside.read_text() == "precious"
    assert (folder / "a.c").read_text() == "new"
    assert not (folder / "a.c").is_symlink()


def test_files_get_the_rights_of_any_other_file(tmp_path):
    (tmp_path / "plain").write_text("")
    [path] = write_all({"a.c": ""}, tmp_path)
    assert stat.S_IMODE(path.stat().st_mode) == stat.S_IMODE((tmp_path / "plain").stat().st_mode)


def test_create_never_overwrites(tmp_path):
    path = tmp_path / "a.di"
    create(path, "first")
    with pytest.raises(FileExistsError):
        create(path, "second")
    assert path.read_text() == "first"
    assert listing(tmp_path) == ["a.di"]


def test_create_leaves_nothing_behind_when_it_fails(tmp_path):
    with pytest.raises(UnicodeEncodeError):
        create(tmp_path / "a.di", "\ud800")
    assert listing(tmp_path) == []


def test_create_does_not_follow_a_dangling_link(tmp_path):
    (tmp_path / "a.di").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(FileExistsError):
        create(tmp_path / "a.di", "text")
    assert not (tmp_path / "elsewhere").exists()


def test_generated_files_replace_each_other_but_nothing_that_a_person_wrote(tmp_path):
    main = tmp_path / "main.c"
    main.write_text("int main(void) { return 0; }\n")
    written = {"main.h": "/* Written by nsode */\n", "main.c": "/* Written by nsode */\n"}
    with pytest.raises(FileExistsError, match="nsode did not write"):
        write_generated(written, tmp_path)
    assert main.read_text() == "int main(void) { return 0; }\n"
    assert not (tmp_path / "main.h").exists()
    main.unlink()
    for _ in range(2):
        assert len(write_generated(written, tmp_path)) == 2


def test_a_failure_names_the_file_and_not_its_draft(tmp_path):
    def fail(file):
        raise OSError(errno.ENOSPC, "no space left on device")

    with pytest.raises(OSError, match="no space") as failure:
        write_binary(tmp_path / "run.npz", fail)
    assert failure.value.filename == str(tmp_path / "run.npz")
    assert listing(tmp_path) == []


def test_a_file_in_the_place_of_the_folder_is_no_folder(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(NotADirectoryError, match="no folder"):
        write_all({"a.c": ""}, tmp_path / "file")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_or_a_device_is_never_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    (tmp_path / "link").symlink_to(pipe)
    for name in ("pipe", "link"):
        with pytest.raises(OSError, match="no regular file"):
            write_all({name: "text"}, tmp_path)
        with pytest.raises(OSError, match="no regular file"):
            write_binary(tmp_path / name, lambda file: file.write(b"text"))
    assert pipe.is_fifo()
    assert listing(tmp_path) == ["link", "pipe"]
