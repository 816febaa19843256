"""`like` with keys of one's own is what `--set` of the same keys gives: every model and nested table."""

import shutil
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest
import tomli_w

from tribodyn.errors import InputError
from tribodyn.input.quantity import LIKE
from tribodyn.input.resolve import resolve
from tribodyn.input.schema import expanded, references
from tribodyn.input.sources import find_scenario, names, shipped
from tribodyn.studies import study_of
from tribodyn.studies.protocol.load import load, table_of

PAIR = 'title = "mine"\nkind = "gear-pair"\nlubricant = "iso-vg-220-mineral"\n'
DUTY = '[operating]\npinion_speed = "600 rpm"\ngear_torque = "150 N*m"\noil_temperature = "60 degC"\n'
DUTY += '[mesh]\ncompliance = "fem"\ndamping_ratio = 0.05\n[friction]\nlaw = "niemann"\n'


def case_of(folder: Path, text: str, overrides: dict[str, Any] | None = None) -> Any:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return load(path, overrides or {}).case


def named_models() -> Iterator[Any]:
    """Every key of the shipped scenarios that names a model by a text, once for each kind of study."""
    seen = set()
    for name in names(shipped("scenarios")):
        data = tomllib.loads(find_scenario(name).read_text(encoding="utf-8"))
        for pattern, mark in references(study_of(data).table(data)).items():
            for key in expanded(pattern, data) if mark.folder else ():
                model = at(data, key)
                if isinstance(model, str) and (data.get("kind"), pattern) not in seen:
                    seen.add((data.get("kind"), pattern))
                    yield pytest.param(name, key, id=f"{name}:{'.'.join(map(str, key))}")


def at(data: Any, key: Iterable[str | int]) -> Any:
    for part in key:
        inside: Any = data.get(part) if isinstance(data, dict) else None
        data = data[part] if isinstance(data, list) and isinstance(part, int) else inside
    return data


def one_of_each_table(table: dict[str, Any], above: tuple[str, ...] = ()) -> dict[tuple[str, ...], Any]:
    """The last plain key of a table and of each table in it, with its value."""
    plain = [name for name, value in table.items() if not isinstance(value, (dict, list))]
    last = {(*above, plain[-1]): table[plain[-1]]} if plain else {}
    for name, value in table.items():
        if isinstance(value, dict):
            last |= one_of_each_table(value, (*above, name))
    return last


@pytest.mark.parametrize(("name", "key"), list(named_models()))
def test_keys_of_ones_own_over_a_model(tmp_path: Path, name: str, key: tuple[str | int, ...]):
    """Each nested table of the model says one key anew; the rest, its title included, stays the model's."""
    written = tomllib.loads(find_scenario(name).read_text(encoding="utf-8"))
    model = at(written, key)
    plain = resolve(find_scenario(name), {}, table_of).data
    own = one_of_each_table(at(plain, key))
    assert own
    changed: dict[str, Any] = {LIKE: model}
    for leaf, value in own.items():
        place = changed
        for part in leaf[:-1]:
            place = place.setdefault(part, {})
        place[leaf[-1]] = value
    at(written, key[:-1])[key[-1]] = changed
    for beside in find_scenario(name).parent.glob("*.csv"):  # columns that a scenario names
        shutil.copy(beside, tmp_path)
    path = tmp_path / f"{name}.toml"
    path.write_text(tomli_w.dumps(written), encoding="utf-8")
    overrides = {".".join(map(str, (*key, *leaf))): value for leaf, value in own.items()}
    by_like, by_set = resolve(path, {}, table_of), resolve(find_scenario(name), overrides, table_of)
    assert (by_like.data, by_like.errors) == (by_set.data, by_set.errors)
    assert at(by_like.data, key).get("title") == at(plain, key).get("title")


def test_a_gear_of_a_named_drive_keeps_its_shift(tmp_path: Path):
    text = PAIR + '[drive]\nlike = "helical-fzg-20-30"\n[drive.gear]\neccentricity = "5 um"\n' + DUTY
    case = case_of(tmp_path, text)
    drive = tomllib.loads(case.toml)["drive"]
    file = tomllib.loads((shipped("models") / "drives" / "helical-fzg-20-30.toml").read_text("utf-8"))
    assert drive["gear"]["profile_shift"] == file["gear"]["profile_shift"] == 0.0891
    assert drive["gear"]["eccentricity"] == "5 um"
    assert [drive[key] for key in ("title", "source")] == [file[key] for key in ("title", "source")]


def test_nested_tables_of_a_drive_file_keep_what_they_say(tmp_path: Path):
    """Shift and tip relief of a file, its material by name and a file that is like it."""
    (tmp_path / "base.toml").write_text(
        'family = "involute"\nmodule = "3 mm"\npressure_angle = "20 deg"\nroughness = "0.5 um"\n'
        'material = "18CrNiMo7-6"\n'
        '[pinion]\nteeth = 23\nface_width = "20 mm"\nprofile_shift = 0.4\n'
        '[pinion.modification]\ntip_relief = "30 um"\n'
        '[gear]\nteeth = 47\nface_width = "20 mm"\n',
        encoding="utf-8",
    )
    (tmp_path / "upon.toml").write_text('like = "base.toml"\n[gear]\nprofile_shift = 0.1\n', encoding="utf-8")
    own = (
        '[drive.material]\nhardness = "6.5 GPa"\n[drive.pinion.modification]\ncrowning = "8 um"\n'
        '[drive.gear.material]\nlike = "16MnCr5"\npoisson_ratio = 0.29\n'
    )
    drive = tomllib.loads(case_of(tmp_path, PAIR + '[drive]\nlike = "upon.toml"\n' + own + DUTY).toml)[
        "drive"
    ]
    assert (drive["pinion"]["profile_shift"], drive["gear"]["profile_shift"]) == (0.4, 0.1)
    assert drive["pinion"]["modification"]["tip_relief"] == "30 um"
    assert drive["pinion"]["modification"]["crowning"] == "8 um"
    assert (drive["material"]["hardness"], drive["material"]["treatment"]) == ("6.5 GPa", "case-hardened")
    assert drive["gear"]["material"]["poisson_ratio"] == 0.29
    named = case_of(
        tmp_path,
        PAIR + 'drive = "upon.toml"\n' + DUTY,
        {
            "drive.material.hardness": "6.5 GPa",
            "drive.pinion.modification.crowning": "8 um",
            "drive.gear.material": {"like": "16MnCr5", "poisson_ratio": 0.29},
        },
    )
    assert tomllib.loads(named.toml)["drive"] == drive


def test_an_oil_keeps_the_temperature_of_its_film(tmp_path: Path):
    named, like = (
        tomllib.loads(case_of(tmp_path, text).toml)["lubricant"]
        for text in (
            PAIR + 'drive = "helical-fzg-20-30"\n' + DUTY,
            PAIR.replace('"iso-vg-220-mineral"', '{ like = "iso-vg-220-mineral" }')
            + 'drive = "helical-fzg-20-30"\n'
            + DUTY,
        )
    )
    assert like == named


def test_a_ring_stays_internal(tmp_path: Path):
    text = PAIR + '[drive]\nlike = "ring-36-93"\n[drive.gear]\nquality = 6\n' + DUTY
    assert tomllib.loads(case_of(tmp_path, text).toml)["drive"]["gear"]["internal"] is True


def test_files_that_are_like_one_another_are_refused(tmp_path: Path):
    (tmp_path / "a.toml").write_text('like = "b.toml"\n', encoding="utf-8")
    (tmp_path / "b.toml").write_text('like = "a.toml"\n', encoding="utf-8")
    with pytest.raises(InputError, match=r'drive\.like = "a\.toml": is like itself'):
        case_of(tmp_path, PAIR + 'drive = "a.toml"\n' + DUTY)


def test_a_key_with_dots_over_a_model_is_said_with_the_file_that_it_stands_in(tmp_path):
    drive = '[drive]\nlike = "spur-25-51"\n[drive.pinion.modification]\n"a.b" = 1\n'
    with pytest.raises(InputError, match="unknown key") as caught:
        case_of(tmp_path, PAIR + 'bearings = "rigid-1e9"\n' + drive + DUTY)
    assert caught.value.file == str(tmp_path / "mine.toml")
