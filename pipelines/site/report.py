"""The page of a site and the file of its values; the same site gives the same bytes."""

from importlib.resources import files

import numpy as np

from hakobune.mooring.environment.wind_profile import speed_at
from hakobune.mooring.site.extremes import plotting_positions

from ..common.picture import data_address
from ..printing.number import fixed

HEAD = "# Values of a site, by hakobune site; studies read it by [site] file, state, level"


def written_by_site(path):
    """Whether a file was written by `hakobune site`, which may replace it"""
    return path.read_text(encoding="utf-8", errors="replace").startswith(HEAD)


def values_text(study, values):
    """TOML of the values: [site], [water], [levels], [states.NAME.wind] …, [contour], [earthquake]"""
    import tomli_w

    own = study.site
    tables = {
        "site": {
            "name": own.name,
            "service_life": own.service_life,
            "probability": values.probability,
            "return_period": values.years,
        },
        "water": {"depth": own.depth},
        "levels": values.levels,
        "states": values.states,
    }
    if values.climate is not None:
        one = values.climate
        tables["contour"] = {
            "return_period": values.years,
            "period_kind": one.law.period_kind,
            "height": [float(f"{value:.5g}") for value in one.height],
            "period": [float(f"{value:.5g}") for value in one.period],
        }
    if values.seismic is not None:
        tables["earthquake"] = {"rule": study.earthquake.rule, "coefficient": values.seismic}
    return f"{HEAD}\n{tomli_w.dumps(tables)}"


def page(study, values, text):
    """The page (HTML), without external files"""
    from jinja2 import Environment, StrictUndefined

    template = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    fits = [
        _fit(name, one, values.years)
        for name, one in (("wind, m/s as measured", values.wind), ("significant height, m", values.waves))
        if one is not None and one.fit is not None
    ]
    return environment.from_string(template).render(
        site=study.site, values=values, fits=fits, text=text, profile=_profile(study, values),
        earthquake=study.earthquake, current=_current(study, values), climate=_climate(values),
    )  # fmt: skip


def _profile(study, values):
    if study.wind is None:
        return []
    heights = study.wind.heights
    return [(f"{z:g}", fixed(float(speed_at(z, values.wind_10, study.wind.exponent)))) for z in heights]


def _current(study, values):
    """Depth and speed, in words, of the current of the extreme state"""
    if values.profile is None:
        return []
    return [(f"{z:g}", fixed(float(values.profile.velocity(-z)[0]))) for z in study.current.depths]


def _climate(values):
    """Picture and laws of the joint law of height and period, None if the site has no such law"""
    if values.climate is None:
        return None
    law = values.climate.law
    return {
        "picture": data_address(lambda path: draw_contour(path, values)),
        "height": "γ {:.3g} m, α {:.3g} m, β {:.3g}".format(*law.weibull),
        "mean": "{:.4g} + {:.4g} H^{:.3g}".format(*law.mean),
        "spread": "{:.3g} + {:.3g} exp(−{:.3g} H)".format(*law.spread),
        "kind": law.period_kind.replace("_", " "),
        "top": "{:.3g} m, {:.3g} s".format(*values.climate.top),
    }


def draw_contour(path, values):
    """The scatter and contours of one year, ten years and the return period"""
    from matplotlib.figure import Figure

    from ..common.picture import save

    one, figure = values.climate, Figure(figsize=(7, 4.6), layout="constrained")
    axes = figure.add_subplot()
    states = np.array(list(one.scatter.states()))
    axes.scatter(states[:, 1], states[:, 0], s=600 * states[:, 2] ** 0.5, color="0.7", label="seas of the table")
    for years in sorted({1.0, 10.0} - {values.years}):
        height, period = one.law.contour(years, one.hours)
        axes.plot(period, height, lw=0.8, ls="--", label="1 year" if years == 1 else f"{years:g} years")
    axes.plot(one.period, one.height, "k-", lw=1.4, label=f"{values.years:.4g} years")
    axes.plot(one.top[1], one.top[0], "rs", ms=5, label="highest")
    axes.set(xlabel=f"{one.law.period_kind.replace('_', ' ')}, s", ylabel="significant height, m", ylim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9)
    save(figure, path, 110)


def _fit(name, extreme, years):
    fit = extreme.fit
    return {
        "name": name,
        "family": fit.family,
        "count": len(fit.maxima),
        "numbers": f"location {fit.location:.4g}, scale {fit.scale:.4g}, shape {fit.shape:.4g}",
        "value": f"{extreme.value:.4g}",
        "interval": f"{extreme.low:.4g} to {extreme.high:.4g}",
        "picture": data_address(lambda path: draw_paper(path, name, extreme, years)),
    }


def draw_paper(path, name, extreme, years):
    """Maxima and their distribution on Gumbel's probability paper, with the interval of the return value"""
    from matplotlib.figure import Figure

    from ..common.picture import save

    fit, figure = extreme.fit, Figure(figsize=(7, 4.2), layout="constrained")
    axes = figure.add_subplot()
    p = plotting_positions(len(fit.maxima))
    axes.plot(-np.log(-np.log(p)), np.sort(fit.maxima), "o", ms=4, label="yearly maxima")
    periods = np.geomspace(1.02, max(200.0, 1.5 * years), 200)
    axes.plot(_reduced(periods), fit.value(periods), "k-", lw=1, label=fit.family)
    spread = [[extreme.value - extreme.low], [extreme.high - extreme.value]]
    axes.errorbar(_reduced(years), extreme.value, spread, fmt="rs", ms=5, capsize=4, label=f"{years:.0f} years")
    ticks = [period for period in (1.1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if period <= periods[-1]]
    axes.set_xticks(_reduced(np.array(ticks)), [f"{tick:g}" for tick in ticks])
    axes.set(xlabel="return period, years", ylabel=name)
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, path, 110)


def _reduced(period):
    return -np.log(-np.log1p(-1 / period))
