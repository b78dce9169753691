"""Words in the place of letters that a terminal cannot write."""

import io

import pytest

from hakobune.pipelines.printing.spelled import spell_out


@pytest.mark.parametrize(
    ("encoding", "text", "said"),
    [
        ("cp1252", "ω = 0.6 rad/s, σ ≤ 2 m², 4√m₀", "omega = 0.6 rad/s, sigma <= 2 m\xb2, 4sqrt m0"),
        ("cp932", "m⁻¹, é, 30°, ω", "m^-1, e, 30°, ω"),
        ("ascii", "10³ × π …", "10^3 x pi ..."),
        ("utf-8", "ω", "ω"),
    ],
)
def test_what_an_encoding_lacks_is_a_word(encoding, text, said):
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    spell_out(stream, None)
    stream.write(text)
    stream.flush()
    assert stream.buffer.getvalue().decode(encoding) == said
