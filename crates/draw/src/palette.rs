//! 256 colours that serve a whole animation.

use crate::canvas::Canvas;
use std::collections::HashMap;
use tiny_physics::{Color, DEPTH_SCALE, Layer, Palette};

/// Red, green and blue.
type Rgb = [u8; 3];

/// Colours that an animation may use, chosen by median cut, and the way to the nearest.
#[derive(Debug)]
pub struct ColorTable {
    colors: Vec<Rgb>,
    known: HashMap<Rgb, u8>,
}

impl ColorTable {
    /// Greatest number of colours; one of 256 is kept for "as before".
    pub const MAX_COLORS: usize = 255;

    /// A table for the colours of a first frame and everything that later frames of a debug drawing can bring: bodies
    /// that fall asleep, depths, text, each with its shades against the background.
    pub fn for_frames(first: impl Iterator<Item = Rgb>) -> Self {
        const EXPECTED: usize = 50;
        let expected = drawing_colors();
        let expected = expected.iter().flat_map(|color| core::iter::repeat_n(*color, EXPECTED));
        Self::of(first.chain(expected), Self::MAX_COLORS + 1)
    }

    /// A table of fewer than `most` colours (8 to 256) for pixels like these: frequent ones are met best.
    pub fn of(pixels: impl IntoIterator<Item = Rgb>, most: usize) -> Self {
        let mut counts: HashMap<Rgb, f32> = HashMap::new();
        for color in pixels {
            *counts.entry(color).or_default() += 1.0;
        }
        let mut weighted: Vec<_> =
            counts.into_iter().map(|(color, count)| (color, count.sqrt())).collect();
        weighted.sort_by_key(|(color, _)| *color);
        let most = (most - 1).clamp(7, Self::MAX_COLORS);
        Self { colors: median_cut(weighted, most), known: HashMap::new() }
    }

    /// Number of colours.
    pub fn len(&self) -> usize {
        self.colors.len()
    }

    /// Has it no colour? Only where there were no pixels.
    pub fn is_empty(&self) -> bool {
        self.colors.is_empty()
    }

    /// Red, green, blue of all colours in a row.
    pub fn bytes(&self) -> Vec<u8> {
        self.colors.iter().flatten().copied().collect()
    }

    /// Index of the nearest colour.
    pub fn nearest(&mut self, color: Rgb) -> u8 {
        let colors = &self.colors;
        *self.known.entry(color).or_insert_with(|| {
            let distance = |other: &Rgb| -> i32 {
                (0..3).map(|i| (i32::from(other[i]) - i32::from(color[i])).pow(2)).sum()
            };
            let best = colors.iter().enumerate().min_by_key(|(_, other)| distance(other));
            best.map_or(0, |(index, _)| index as u8)
        })
    }
}

/// Every colour that a drawing is made of, and its shades against the background.
fn drawing_colors() -> Vec<Rgb> {
    let palette = Palette::default();
    let layers = [Layer::Static, Layer::Kinematic, Layer::Awake, Layer::Asleep];
    let lines = [Layer::Joint, Layer::Normal, Layer::Mass];
    let mut base: Vec<Color> =
        layers.iter().chain(&lines).map(|layer| palette.color(*layer)).collect();
    for pair in DEPTH_SCALE.windows(2) {
        base.extend((0..4).map(|k| pair[0].1.mix(pair[1].1, k as f32 / 4.0)));
    }
    base.push(Color::WHITE);
    let shades = [0.0, 0.3, 0.42, 0.55, 0.62, 0.8];
    base.iter()
        .flat_map(|color| shades.map(|t| color.mix(Canvas::BACKGROUND, t)))
        .map(|color| [color.r, color.g, color.b])
        .collect()
}

/// Splits the colours into at most `limit` groups, always the group with the greatest weighted
/// spread along its widest channel, and gives the weighted mean of each.
fn median_cut(colors: Vec<(Rgb, f32)>, limit: usize) -> Vec<Rgb> {
    let mut groups = vec![colors];
    while groups.len() < limit {
        let Some((index, channel, _)) = widest(&groups) else { break };
        let mut group = groups.swap_remove(index);
        group.sort_by_key(|(color, _)| color[channel]);
        let half: f32 = group.iter().map(|(_, weight)| weight).sum::<f32>() * 0.5;
        let mut sum = 0.0;
        let middle = group.iter().position(|(_, weight)| {
            sum += weight;
            sum > half
        });
        let cut = middle.unwrap_or(0).clamp(1, group.len() - 1);
        let rest = group.split_off(cut);
        groups.push(group);
        groups.push(rest);
    }
    groups.iter().filter(|group| !group.is_empty()).map(|group| mean(group)).collect()
}

/// The group to split next: index, channel, spread. `None` where every group is one colour.
fn widest(groups: &[Vec<(Rgb, f32)>]) -> Option<(usize, usize, f32)> {
    let mut best = None;
    for (index, group) in groups.iter().enumerate() {
        let weight: f32 = group.iter().map(|(_, weight)| weight).sum();
        for channel in 0..3 {
            let values = group.iter().map(|(color, _)| color[channel]);
            let (Some(low), Some(high)) = (values.clone().min(), values.max()) else { continue };
            let spread = f32::from(high - low) * weight.sqrt();
            if high > low && best.is_none_or(|(_, _, most)| spread > most) {
                best = Some((index, channel, spread));
            }
        }
    }
    best
}

fn mean(group: &[(Rgb, f32)]) -> Rgb {
    let total: f32 = group.iter().map(|(_, weight)| weight).sum();
    [0, 1, 2].map(|channel| {
        let sum: f32 = group.iter().map(|(color, w)| f32::from(color[channel]) * w).sum();
        (sum / total + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_colours_are_kept_and_all_are_near() {
        let background = Canvas::BACKGROUND;
        let background = [background.r, background.g, background.b];
        let frame =
            core::iter::repeat_n(background, 100_000).chain((0..=255).map(|i| [i, 40, 255 - i]));
        let mut table = ColorTable::for_frames(frame);
        assert!(table.colors.len() <= ColorTable::MAX_COLORS);
        let palette = Palette::default();
        for color in [palette.awake, palette.asleep, palette.fixed, DEPTH_SCALE[4].1] {
            let index = table.nearest([color.r, color.g, color.b]);
            let found = table.colors[usize::from(index)];
            let off = [color.r, color.g, color.b]
                .iter()
                .zip(found)
                .map(|(a, b)| i32::from(*a).abs_diff(i32::from(b)))
                .max();
            assert!(off < Some(16), "{color:?} became {found:?}");
        }
        let index = usize::from(table.nearest(background));
        assert_eq!(table.colors[index], background);
    }

    #[test]
    fn few_colours_are_exact() {
        let colors = median_cut(vec![([1, 2, 3], 1.0), ([200, 2, 3], 5.0)], 255);
        assert_eq!(colors.len(), 2);
        assert!(colors.contains(&[1, 2, 3]) && colors.contains(&[200, 2, 3]));
        assert!(median_cut(Vec::new(), 255).is_empty());
    }
}
