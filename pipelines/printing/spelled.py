"""Words for letters that a terminal cannot write, such as ω (cp1252, cp932), so that no message is lost."""

import codecs
import unicodedata

SIGNS = {
    "−": "-", "–": "-", "—": "-", "×": "x", "·": "*", "÷": "/", "√": "sqrt ", "∞": "inf", "≤": "<=", "≥": ">=",
    "≠": "!=", "≈": "~", "→": "->", "←": "<-", "±": "+-", "°": " deg", "∫": "int ", "∬": "int ", "∂": "d",
}  # fmt: skip
SET_UP = {**dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True)), "⁻": "-"}


def spelled(error):
    """Replacement for the characters of a UnicodeEncodeError, and the place where writing continues"""
    text, end = "", error.end
    for i in range(error.start, end):
        letter = error.object[i]
        if letter in SET_UP:
            text += ("" if i and error.object[i - 1] in SET_UP else "^") + SET_UP[letter]
        else:
            text += _word(letter)
    return text, end


def _word(letter):
    name = unicodedata.name(letter, "").split()
    if name[:1] == ["GREEK"] and name[2] == "LETTER":
        word = name[3].lower()
        return word.capitalize() if name[1] == "CAPITAL" else word
    plain = unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode()
    return SIGNS.get(letter) or plain or "?"


def spell_out(*streams):
    """Let text streams write words for characters outside their encoding"""
    codecs.register_error("spelled", spelled)
    for stream in streams:
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="spelled")
