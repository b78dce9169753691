"""The numbers that `hakobune sea` prints, against text-book formulas and records whose waves are known one by one."""

import json
from math import gamma, pi, sqrt

import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.sea.report import is_spectrum
from hakobune.pipelines.sea.result import _point


def found_by(words, capsys):
    """Quantities {name: values}, and labels {axis: values}, of a command"""
    assert main([*words, "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    return [{name: one["values"] for name, one in made[part].items()} for part in ("quantities", "axes")]


def rows(made, axes, name, axis):
    """{label without its words: value}"""
    return {label.split(",")[0]: value for label, value in zip(axes[axis], made[name], strict=True)}


def test_a_two_parameter_spectrum_has_the_moments_and_periods_of_its_closed_form(capsys):
    """S = A ω⁻⁵ exp(−Bω⁻⁴): m_n = (A/4) B^{n/4−1} Γ(1 − n/4) (Bretschneider 1959; Price & Bishop 1974, ch. 7), and
    Tp = 2π (4B/5)^{−1/4}.  One period sets B; m₀ = H²/16."""
    found, axes = found_by(["sea", "--height", "3", "--mean-period", "8"], capsys)
    T = rows(found, axes, "period.spectrum", "kind")
    B = 0.8**-1 * (2 * pi / T["Tp"]) ** 4  # 4B/5 = (2π/Tp)⁴
    A = 4 * B * 3**2 / 16
    m = {n: A / 4 * B ** (n / 4 - 1) * gamma(1 - n / 4) for n in (-1, 0, 1, 2, 3)}
    assert [found[f"m{n}"] for n in m] == pytest.approx(list(m.values()), rel=2e-4)
    assert T["T01"] == pytest.approx(2 * pi * m[0] / m[1], rel=2e-4)
    assert T["T02"] == pytest.approx(2 * pi * sqrt(m[0] / m[2]), rel=2e-4)
    assert T["Te"] == pytest.approx(2 * pi * m[-1] / m[0], rel=2e-4)
    assert T["T01"] == pytest.approx(8.0, rel=3e-3)  # ISSC prints its constants 0.11 and 0.44 to two digits
    assert found["width"] == pytest.approx(sqrt(m[0] * m[2] / m[1] ** 2 - 1), rel=2e-4)


def test_heights_of_a_narrow_spectrum_are_those_of_rayleigh(capsys):
    """Longuet-Higgins (1952), in 4√m₀ = 1: mean √(2π)/4 = 0.6267, H1/3 1.0011, H1/10 1.2727, and the expected highest
    of 1000 √(2 ln N)/2 + γ/(2√(2 ln N)) = 1.9361 (he prints 1.53 √(2 ln N) H_rms for the first term)"""
    found = rows(*found_by(["sea", "--height", "2", "--mean-period", "8"], capsys), "height.spectrum", "of")
    assert found["4√m₀"] == pytest.approx(2.0, rel=1e-4)
    assert found["mean"] == pytest.approx(2 * 0.6267, rel=2e-4)
    assert found["H1/3"] == pytest.approx(2 * 1.0011, rel=2e-4)
    assert found["H1/10"] == pytest.approx(2 * 1.2727, rel=2e-4)
    assert found["highest of 1000"] == pytest.approx(2 * 1.9361, rel=2e-4)


def test_a_record_of_thirty_known_waves_has_the_means_of_its_highest_ten_and_three(tmp_path, capsys):
    """Each wave is one whole sine of its own height and period, in mixed order: the mean of all, of the highest third
    (ten) and of the highest tenth (three) are sums by hand, as is the mean period and that of the highest third."""
    heights = 0.5 + 0.1 * np.array([(7 * i) % 30 for i in range(30)])  # 0.5 … 3.4 m, each once
    lengths = np.where(heights > 2.35, 80, 60)  # values a wave: the highest ten are longer; step 0.1 s
    waves = [0.5 * h * np.sin(2 * pi * np.arange(n) / n) for h, n in zip(heights, lengths, strict=True)]
    record = np.concatenate([[-0.01], *waves, [0.01]])
    path = tmp_path / "waves.csv"
    lines = [f"{0.1 * i:.1f},{value:.9g}" for i, value in enumerate(record)]
    path.write_text("\n".join(["time_s,elevation_m", *lines]), encoding="utf-8")
    found = found_by(["sea", str(path)], capsys)
    height, period = rows(*found, "height.record", "of"), rows(*found, "period.record", "kind")
    inside = np.sort(heights)
    assert height["mean"] == pytest.approx(inside.mean(), rel=0.01)
    assert height["H1/3"] == pytest.approx(inside[-10:].mean(), rel=0.01)
    assert height["H1/10"] == pytest.approx(inside[-3:].mean(), rel=0.01)
    assert max(v for name, v in height.items() if name.startswith("highest")) == pytest.approx(3.4, rel=0.005)
    assert period["T1/3"] == pytest.approx(8.0, rel=0.01)
    assert period["T02"] == pytest.approx(lengths.mean() / 10, rel=0.02)


def test_a_place_is_its_two_numbers_in_their_order():
    assert _point("3,-4.5") == _point((3, -4.5)) == (3.0, -4.5)
    assert _point(None) == (0.0, 0.0)
    with pytest.raises(ValueError, match=r"--point is '1'; allowed: two numbers x,y"):
        _point("1")


def test_a_table_of_several_spectra_is_read_at_its_time(tmp_path, capsys):
    """H = 4 √(Σ S Δf) of equal steps: the second row has four times the density of the first, twice its height"""
    path = tmp_path / "41010w2026.txt"
    bands = [0.05, 0.1, 0.15, 0.2]
    rows = [[0.0, 1.0, 2.0, 0.0], [0.0, 4.0, 8.0, 0.0]]
    text = "#YY MM DD hh mm" + "".join(f" {f:.4f}" for f in bands)
    for hour, row in enumerate(rows):
        text += f"\n2026 01 02 {hour:02d} 00 " + " ".join(map(str, row))
    path.write_text(text + "\n")
    m0 = [found_by(["sea", "--table", str(path), "--time", f"2026 01 02 {k:02d} 00"], capsys)[0]["m0"] for k in (0, 1)]
    assert m0[0] == pytest.approx(0.05 * 3.0) and m0[1] == pytest.approx(4 * m0[0])
    assert main(["sea", "--table", str(path)]) == 2
    assert "has 2 rows; choose one with time" in capsys.readouterr().err
    assert main(["sea", "--height", "3", "--mean-period", "8", "--time", "2026"]) == 2
    assert "--time is given without --table" in capsys.readouterr().err


def test_a_spectrum_written_here_is_known_by_its_first_line_and_its_columns(tmp_path):
    said, columns = "# JONSWAP; 4 sqrt(m0) 2 m, Tp 8 s\n", "omega_rad_s,density_m2_s_rad"
    for first, names, ours in ((said, columns, True), (said, columns + ",low_m2_s_rad,high_m2_s_rad", True),
                               (said, "time_s,elevation_m", False), (said, "", False),
                               ("# measured\n", columns, False)):  # fmt: skip
        (tmp_path / "a.csv").write_text(f"{first}{names}\n0.5,1\n")
        assert is_spectrum(tmp_path / "a.csv") == ours
