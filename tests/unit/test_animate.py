"""Moving pictures of a run, and figures that a notebook shows."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest

import nsode
from nsode.simulate import Mode
from support.models import MODELS

pytest.importorskip("matplotlib")
Image = pytest.importorskip("PIL.Image")

LIMITS = (-0.5, 0.5, -0.1, 1.1)


@pytest.fixture(scope="module")
def dropped():
    return nsode.load(MODELS / "bouncing_mass.di").simulate(0.4, 1e-3)


def dot(axis, now):
    axis.set_axis_off()
    axis.plot(0, now["p"], "o", color="red", ms=8)


def heights(pictures):
    """Return the mean row of what is red, from the top, in pixels."""
    red = [(np.array(one) @ [1, -1, 0]) > 100 for one in pictures]
    return np.array([np.nonzero(one)[0].mean() for one in red])


def test_what_is_drawn_falls_as_the_law_of_gravity_says(dropped):
    animation = dropped.animate(dot, LIMITS)
    t = np.arange(11) / 25
    seen = heights(animation.pictures())
    slope, _ = np.polyfit(4.9 * t**2, seen, 1)
    away = seen - seen[0] - slope * 4.9 * t**2
    assert slope > 100  # pixels for a meter
    assert np.abs(away).max() < 1


def test_the_speed_chooses_the_moments(dropped):
    moments = []
    list(dropped.animate(lambda _, now: moments.append(now.t), LIMITS, 0.1, 10).pictures())
    assert moments == pytest.approx(np.arange(41) / 100, abs=1e-12)


def test_a_moment_knows_values_vectors_and_modes():
    run = nsode.load(MODELS / "rolling_sphere.di").simulate(0.4, 1e-3)
    seen = []

    def look(_, now):
        seen.append((now["p"], now["v.z"], now.mode("N")))

    list(run.animate(look, LIMITS, rate=5).pictures())
    assert [mode for *_, mode in seen] == [Mode.FREE, Mode.FREE, Mode.FREE]
    place, speed, _ = seen[1]
    assert place == pytest.approx([5.5 * 0.2, 0, 1 - 4.9 * 0.04])
    assert speed == pytest.approx(-9.8 * 0.2)


def test_a_saved_animation_is_a_gif_of_that_pace(dropped, tmp_path):
    with Image.open(dropped.animate(dot, LIMITS, speed=0.5).save(tmp_path / "x.gif")) as gif:
        assert (gif.format, gif.n_frames, gif.info["duration"]) == ("GIF", 21, 40)


@pytest.mark.parametrize(
    ("limits", "speed", "rate"),
    [((1, 0, 0, 1), 1, 25), ((0, 1, 0, 0), 1, 25), (LIMITS, 0, 25), (LIMITS, 1, 51)],
)
def test_senseless_pictures_are_refused(dropped, limits, speed, rate):
    with pytest.raises(ValueError, match=r"limits are|the speed is"):
        dropped.animate(dot, limits, speed, rate)


def test_endless_pictures_are_refused_before_they_are_drawn(dropped):
    with pytest.raises(ValueError, match="10001 pictures are too many"):
        dropped.animate(dot, LIMITS, speed=1e-3)


def test_a_plot_shows_itself_in_a_notebook_without_pyplot(dropped):
    formatters = pytest.importorskip("IPython.core.formatters")
    data, _ = formatters.DisplayFormatter().format(dropped.plot("p"))
    with Image.open(BytesIO(data["image/png"])) as picture:
        assert picture.width > 500


def test_an_animation_shows_itself_in_a_notebook(dropped):
    formatters = pytest.importorskip("IPython.core.formatters")
    data, _ = formatters.DisplayFormatter().format(dropped.animate(dot, LIMITS, rate=5))
    assert data["text/plain"] == "<animation of bouncing_mass: 3 pictures>"
    assert data["image/gif"].startswith("R0lGODlh")  # GIF89a
