"""Each criterion is met by 1 % and missed by 1 %; nothing that cannot be judged is called met"""

import numpy as np
import pytest

from hakobune.mooring.criteria import verdict
from hakobune.mooring.criteria.rules import RuleError, of_rule, read_rules, rule_names
from hakobune.mooring.criteria.verdict import Case, Tensions, judge

RULES = read_rules()
BREAK = 1.0e7


def a_case(criterion, used):
    """A Case that uses a share `used` of a criterion, the limit inverted by hand"""
    limit, static, largest, pretension, worn, holding = criterion.limit, 0.0, 1.0, 1.0, BREAK, 1.0
    value = used * limit if criterion.sense == "at most" else limit / used
    match criterion.quantity:
        case verdict.SAFETY:
            largest = BREAK / value
        case verdict.SHARE:
            largest = value * BREAK
        case verdict.PRETENSION:
            pretension = value * BREAK
        case verdict.WORN:
            worn = 0.8 * BREAK
            largest = value * worn
        case verdict.HOLDING:
            holding = value
        case verdict.FACTOR:
            largest = used * 0.95 * BREAK / limit
        case verdict.PARTIAL:
            static = 0.3 * used * 0.95 * BREAK
            largest = static + (used * 0.95 * BREAK - limit * static) / criterion.second
    lines = (("one", "two"), *(np.array([0.5 * v, v]) for v in (pretension, static, largest)))
    tensions = Tensions(*lines, np.full(2, BREAK), np.full(2, worn), np.ones(2), np.array([2 * holding, holding]))
    state, broken, analysis = (
        {"any": first}.get(own, own)
        for own, first in (
            (criterion.state, "normal"),
            (criterion.lines, "intact"),
            (criterion.analysis, "quasi-static"),
        )
    )
    half = 0.5 if criterion.statistic == "peak to peak" else 1.0
    own = {criterion.quantity: half * value}
    return Case("case", state, broken, analysis, {criterion.motion_factor: tensions}, own, {})


@pytest.mark.parametrize("criterion", RULES, ids=lambda c: f"{c.rule} {c.quantity} {c.subject} {c.lines} {c.analysis}")
def test_one_per_cent_below_is_met_and_one_above_is_not(criterion):
    for used, met in ((0.99, True), (1.01, False)):
        (judged,) = judge([criterion], [a_case(criterion, used)])
        assert judged.met is met and judged.governing.utilisation == pytest.approx(used, rel=1e-9)
        if criterion.quantity.endswith("tension") or "load" in criterion.quantity.split("/")[0]:
            assert judged.governing.item in ("two", criterion.quantity)


def test_the_case_that_governs_is_the_worst_of_those_the_criterion_is_for():
    (normal,) = [c for c in of_rule(RULES, "JSCE") if c.state == "normal"]
    cases = [a_case(normal, used)._replace(name=f"{used}") for used in (0.4, 0.9, 0.7)]
    cases.append(a_case(normal, 5.0)._replace(name="extreme", state="abnormal"))
    (judged,) = judge([normal], cases)
    assert judged.governing.case == "0.9" and len(judged.uses) == 3


def test_what_cannot_be_judged_is_not_called_met():
    chain = of_rule(RULES, "API RP 2SK")[0]
    case = a_case(chain, 0.5)
    unknown = case.tensions[1.0]._replace(breaking=np.array([BREAK, np.inf]))
    (judged,) = judge([chain], [case._replace(tensions={1.0: unknown})])
    assert judged.met is None and "breaking load of two" in judged.missing
    (judged,) = judge([chain], [case._replace(lines="one lost")])
    assert judged.met is None and "no load case is lines intact, quasi-static" in judged.missing
    worn = of_rule(RULES, "port facility II", "chain of a multi-point mooring")[0]
    (judged,) = judge([worn], [case])
    assert judged.met is None and "1.5 times the motion" in judged.missing


def test_a_file_of_the_users_own_has_the_form_of_the_tables(tmp_path):
    head = ",".join(RULES[0]._fields)
    own = tmp_path / "own.csv"
    own.write_text(f"# ours\n{head}\nport X,2026,surge,at most,1/4,,m,any,any,any,barge,amplitude,,bylaw 7,read\n")
    (criterion,) = read_rules(own)
    assert criterion.limit == 0.25 and rule_names([criterion]) == ("port X",)
    for wrong, message in (("1/4", "limit is '0'"), ("at most", "sense is '0'"), ("read", "status is '0'")):
        own.write_text(own.read_text().replace(f",{wrong}", ",0"))
        with pytest.raises(RuleError, match=message):
            read_rules(own)
        own.write_text(own.read_text().replace(",0", f",{wrong}", 1))
    with pytest.raises(RuleError, match="unknown; allowed: JSCE"):
        of_rule(RULES, "Lloyd's")
    with pytest.raises(RuleError, match="no criterion for 'ice'"):
        of_rule(RULES, "JSCE", "ice")


def test_a_part_of_a_subject_leads_to_the_subjects_that_contain_it():
    with pytest.raises(RuleError) as refused:
        of_rule(RULES, "PIANC", "bulk carrier")
    named = ("cranes", "elevator / bucket wheel", "conveyor belt")
    assert str(refused.value).endswith("allowed: " + ", ".join(f'"bulk carrier; {one}"' for one in named))


def test_a_limit_in_another_unit_than_its_quantity_has_is_refused(tmp_path):
    rows = "\n".join((",".join(RULES[0]._fields), "own,1,surge,at most,3,,ft,any,any,any,ship,largest,,harbour,read"))
    (tmp_path / "own.csv").write_text(rows)
    with pytest.raises(RuleError, match="criterion 1: unit of surge is 'ft'; allowed: m"):
        read_rules(tmp_path / "own.csv")
    (tmp_path / "own.csv").write_text(rows.replace("ft", ""))
    assert read_rules(tmp_path / "own.csv")[0].unit == "m"
