//! All figures of a run beside those of an earlier one.

use std::collections::BTreeMap;

use serde::Serialize;

use super::gate::{Gate, GateFigure, GateKind, GateLimits, Verdict, differences};
use crate::report::{Grid, cells::number};

/// A figure then and now.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// How it is judged.
    pub kind: GateKind,
    /// Then.
    pub before: f64,
    /// Now.
    pub now: f64,
    /// How it did.
    pub verdict: Verdict,
}

/// All figures then and now.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Judgement {
    /// Figures that both have.
    pub judged: Vec<Judged>,
    /// Figures that only the baseline has.
    pub gone: Vec<String>,
    /// Figures that only the new run has.
    pub new: Vec<String>,
    /// Circumstances that differ, a sentence each.
    pub differs: Vec<String>,
}

impl Gate {
    /// Judges every figure against an earlier run's.
    pub fn judge(&self, before: &Self, limits: GateLimits) -> Judgement {
        let of = |gate: &Self| -> BTreeMap<String, GateFigure> {
            gate.figures.iter().map(|figure| (figure.name.clone(), figure.clone())).collect()
        };
        let (then, now) = (of(before), of(self));
        let judge = |figure: &GateFigure| {
            let before = then.get(&figure.name)?;
            let verdict = figure.verdict(before, limits);
            let (name, kind) = (figure.name.clone(), figure.kind);
            Some(Judged { name, kind, before: before.value, now: figure.value, verdict })
        };
        let only = |these: &[GateFigure], others: &BTreeMap<String, GateFigure>| {
            let names = these.iter().map(|figure| figure.name.clone());
            names.filter(|name| !others.contains_key(name)).collect()
        };
        Judgement {
            judged: self.figures.iter().filter_map(judge).collect(),
            gone: only(&before.figures, &now),
            new: only(&self.figures, &then),
            differs: differences(&before.circumstances, &self.circumstances),
        }
    }
}

impl Judgement {
    /// The figures of a verdict.
    pub fn with(&self, verdict: Verdict) -> impl Iterator<Item = &Judged> {
        self.judged.iter().filter(move |judged| judged.verdict == verdict)
    }

    /// Whether the gate is passed: nothing became worse, nothing is gone, all could be judged.
    pub fn passes(&self) -> bool {
        self.gone.is_empty()
            && !self.judged.is_empty()
            && self.with(Verdict::Worse).next().is_none()
            && self.with(Verdict::NotJudged).next().is_none()
    }

    /// In one line.
    pub fn summary(&self) -> String {
        let count = |verdict| self.with(verdict).count();
        format!(
            "against the baseline: {} worse, {} better, {} the same, {} not judged, {} gone, {} new",
            count(Verdict::Worse),
            count(Verdict::Better),
            count(Verdict::Same),
            count(Verdict::NotJudged),
            self.gone.len(),
            self.new.len()
        )
    }

    /// Everything that is not the same.
    pub fn grid(&self) -> Grid {
        let changed: Vec<&Judged> = self.judged.iter().filter(|own| own.verdict != Verdict::Same).collect();
        let decimals = |own: &Judged| if own.kind == GateKind::TimeOverFloor { 3 } else { 0 };
        Grid::of(self.summary(), &changed)
            .column("figure", |own| own.name.clone())
            .column("before", |own| number(Some(own.before), decimals(own)))
            .column("now", |own| number(Some(own.now), decimals(own)))
            .column("x", |own| number((own.before != 0.0).then(|| own.now / own.before), 3))
            .column("verdict", |own| match own.verdict {
                Verdict::Worse => "WORSE",
                Verdict::Better => "better",
                Verdict::NotJudged => "not judged: too uncertain",
                Verdict::Same => "same",
            })
            .with_notes(
                self.gone
                    .iter()
                    .map(|name| format!("gone: {name}"))
                    .chain(self.differs.iter().map(|differs| format!("note: {differs}"))),
            )
    }
}
