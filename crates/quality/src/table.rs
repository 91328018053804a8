//! The table of results: ours beside the other engines'.

use crate::peers::{Figure, PeerMeasure};
use crate::report::Report;
use crate::target::plain;

/// Names of the columns.
pub const HEADER: [&str; COLUMNS] = [
    "id",
    "name",
    "metric",
    "unit",
    "ours",
    "reference",
    "Box2D",
    "Rapier",
    "target",
    "pass",
    "as good",
];

/// Columns of the table; the last tells whether ours is as good as the best of the others.
pub const COLUMNS: usize = 11;

/// Widths of the columns, negative for those that are flush left.
const WIDTHS: [i32; COLUMNS] = [3, -15, -56, -8, 10, 9, 10, 10, -16, -4, -7];

/// The cells of a row's lines, one line a number. `peers` are the others' figures in the order of the report.
pub fn cells(report: &Report, peers: &[Option<&PeerMeasure>]) -> Vec<[String; COLUMNS]> {
    let short = |figure: Option<&Figure>| figure.map_or_else(|| "-".into(), Figure::short);
    let line = |(i, measure): (usize, &crate::Measure)| {
        let (id, name) = if i == 0 { (report.id, report.name) } else { ("", "") };
        let peer = peers.get(i).copied().flatten();
        [
            id.into(),
            name.into(),
            measure.metric.clone(),
            measure.unit.into(),
            Figure::of(measure.value).short(),
            measure.target.reference().map_or_else(|| "-".into(), |value| plain(value).to_string()),
            short(peer.map(|peer| &peer.box2d)),
            short(peer.map(|peer| &peer.rapier)),
            measure.target.to_string(),
            yes(measure.pass),
            peer.map_or_else(|| "-".into(), |peer| yes(peer.as_good(measure))),
        ]
    };
    report.measures.iter().enumerate().map(line).collect()
}

fn yes(good: bool) -> String {
    if good { "yes" } else { "NO" }.into()
}

/// Is every number of a row as good as the best of the others'? Yes where they cannot play it.
pub fn as_good(report: &Report, peers: &[Option<&PeerMeasure>]) -> bool {
    report.measures.iter().zip(peers).all(|(m, peer)| peer.is_none_or(|peer| peer.as_good(m)))
}

/// One line of the table, cells padded to the columns' widths.
pub fn line(cells: &[impl AsRef<str>; COLUMNS]) -> String {
    let mut line = String::new();
    for (cell, width) in cells.iter().zip(WIDTHS) {
        let (cell, columns) = (cell.as_ref(), width.unsigned_abs() as usize);
        line +=
            &if width < 0 { format!("{cell:<columns$}  ") } else { format!("{cell:>columns$}  ") };
    }
    line.trim_end().into()
}

/// Does a peer meet all targets of a row?
pub fn peer_passes(
    report: &Report,
    peers: &[Option<&PeerMeasure>],
    figure: fn(&PeerMeasure) -> &Figure,
) -> bool {
    report.measures.iter().zip(peers).all(|(measure, peer)| {
        peer.is_some_and(|peer| measure.target.use_of(figure(peer).value()) <= 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Measure, Target};

    #[test]
    fn lines_show_all_engines() {
        let target = Target::Within { value: 0.6667, tolerance: 0.0005 };
        let report = Report::new("12", "rolling", vec![Measure::new("v/v0", 0.66666, "", target)]);
        let peer = PeerMeasure {
            metric: "v/v0".into(),
            box2d: Figure::Value(0.7),
            rapier: Figure::Cannot("no disks".into()),
        };
        let lines = cells(&report, &[Some(&peer)]);
        assert_eq!(lines.len(), 1);
        assert_eq!(
            lines[0][4..],
            ["0.66666", "0.6667", "0.70000", "-", "0.6667 +- 0.0005", "yes", "yes"]
        );
        assert!(as_good(&report, &[Some(&peer)]));
        assert_eq!(line(&HEADER).find("Box2D"), line(&lines[0]).find("0.70000").map(|at| at + 2));
        assert!(!peer_passes(&report, &[Some(&peer)], |peer| &peer.box2d));
    }
}
