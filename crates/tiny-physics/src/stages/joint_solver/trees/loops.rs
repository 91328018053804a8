//! Joints that close loops, solved at once with the tree that they are cut from.
//!
//! With A the matrix of the tree and Jc, Sc and rc what the cuts have, their impulses x follow from how the tree answers them,
//!
//! ```text
//! (Jc A^-1 Jc^T + Sc) x = rc - Jc dv
//! ```
//!
//! where dv is what the tree does without them; then the tree is solved once more, with `Jc^T x` acting on it. The matrix on the left
//! is dense, and small: see [`MOST_CUTS`](crate::dynamics).

use super::factor::{self, dot3, row_count, write_limit};
use crate::dynamics::{JointTree, TreeLink};
use crate::simd::{Simd, Three, add_times};

/// Factors the matrix of a tree, unless that is done.
#[inline(always)]
pub(super) fn factor<S: Simd>(simd: S, tree: &mut JointTree) {
    if core::mem::replace(&mut tree.factored, true) {
        return;
    }
    factor::factor(simd, tree);
    let uncut = tree.uncut();
    if uncut == tree.links.len() {
        return;
    }
    tree.closing.clear();
    for cut in uncut..tree.links.len() {
        write_limit(&mut tree.links[cut]);
        tree.closing.extend((0..row_count(&tree.links[cut])).map(|k| (cut as u32, k as u32)));
    }
    let count = tree.closing.len();
    tree.answered.clear();
    tree.answered.resize(count * count, 0.0);
    let mut first = 0;
    while let Some(&(cut, _)) = tree.closing.get(first) {
        let rows = row_count(&tree.links[cut as usize]);
        for side in 0..2 {
            let TreeLink { a, b, .. } = tree.links[cut as usize];
            factor::answer(simd, tree, [a, b][side]);
            (first..first + rows).for_each(|row| add_answers(simd, tree, row, side));
        }
        first += rows;
    }
    eliminate(&mut tree.answered, count);
}

/// Adds how all cuts from a row of one on give way to an impulse along it on one of its bodies, whose answers are there.
#[inline(always)]
fn add_answers<S: Simd>(simd: S, tree: &mut JointTree, row: usize, side: usize) {
    let JointTree { nodes, links, closing, answered, .. } = tree;
    let link_of = |row: usize| (&links[closing[row].0 as usize], closing[row].1 as usize);
    let (link, k) = link_of(row);
    let own = link.jacobians[side].rows[k];
    for other in row..closing.len() {
        let (link, i) = link_of(other);
        let sum = &mut answered[row * closing.len() + other];
        for (end, jacobian) in [link.a, link.b].into_iter().zip(&link.jacobians) {
            let mut dv: Three = [0.0; 4];
            for (answer, own) in nodes[end as usize].answers.iter().zip(own) {
                add_times(simd, &mut dv, answer, own);
            }
            *sum += dot3(&jacobian.rows[i], &dv);
        }
        if other == row && side == 1 {
            *sum += link.compliance[k];
        }
    }
}

/// Eliminates a symmetric matrix of which the upper half is there: its diagonal becomes the inverse of the pivots.
fn eliminate(matrix: &mut [f64], count: usize) {
    for pivot in 0..count {
        let (upper, lower) = matrix.split_at_mut((pivot + 1) * count);
        let row = &mut upper[pivot * count..];
        let inverse = if row[pivot] > 0.0 { 1.0 / row[pivot] } else { 0.0 };
        for i in pivot + 1..count {
            let factor = row[i] * inverse;
            let target = &mut lower[(i - pivot - 1) * count + i..(i - pivot) * count];
            for (x, y) in target.iter_mut().zip(&row[i..]) {
                *x -= factor * y;
            }
        }
        row[pivot] = inverse;
    }
}

/// Solves for what acts along the rows.
fn resolve(matrix: &[f64], values: &mut [f64]) {
    let count = values.len();
    for pivot in 0..count {
        let row = &matrix[pivot * count..][..count];
        let factor = values[pivot] * row[pivot];
        for (value, x) in values[pivot + 1..].iter_mut().zip(&row[pivot + 1..]) {
            *value -= factor * x;
        }
    }
    for pivot in (0..count).rev() {
        let row = &matrix[pivot * count..][..count];
        let later = row[pivot + 1..].iter().zip(&values[pivot + 1..]);
        let taken: f64 = later.map(|(x, value)| x * value).sum();
        values[pivot] = row[pivot] * (values[pivot] - taken);
    }
}

/// Solves for the right sides of all links, and an impulse of one on a node along x, y or about if there is one.
#[inline(always)]
pub(super) fn solve<S: Simd>(simd: S, tree: &mut JointTree, push: Option<(u32, usize)>) {
    begin(tree, push);
    factor::solve(simd, tree);
    let uncut = tree.uncut();
    if uncut == tree.links.len() {
        return;
    }
    let JointTree { nodes, links, closing, answered, wanted, .. } = tree;
    wanted.clear();
    for &(cut, k) in &*closing {
        let TreeLink { a, b, jacobians: [on_a, on_b], rhs, .. } = &links[cut as usize];
        let moves = dot3(&on_a.rows[k as usize], &nodes[*a as usize].dv)
            + dot3(&on_b.rows[k as usize], &nodes[*b as usize].dv);
        wanted.push(rhs[k as usize] - moves);
    }
    resolve(answered, wanted);
    begin(tree, push);
    let JointTree { nodes, links, closing, wanted, .. } = tree;
    links[uncut..].iter_mut().for_each(|link| link.change = [0.0; 4]);
    for (&(cut, k), &impulse) in closing.iter().zip(&*wanted) {
        let link = &mut links[cut as usize];
        link.change[k as usize] = impulse;
        for (end, jacobian) in [link.a, link.b].into_iter().zip(&link.jacobians) {
            add_times(simd, &mut nodes[end as usize].g, &jacobian.rows[k as usize], impulse);
        }
    }
    factor::solve(simd, tree);
}

/// Nothing acts on the nodes but this.
fn begin(tree: &mut JointTree, push: Option<(u32, usize)>) {
    tree.nodes[..tree.dynamic].iter_mut().for_each(|node| node.g = [0.0; 4]);
    if let Some((node, k)) = push {
        tree.nodes[node as usize].g[k] = 1.0;
    }
}

/// Works out the answers of all nodes to impulses of one on a node.
#[inline(always)]
pub(super) fn answer<S: Simd>(simd: S, tree: &mut JointTree, node: u32) {
    if tree.uncut() == tree.links.len() {
        return factor::answer(simd, tree, node);
    }
    tree.links.iter_mut().for_each(|link| link.rhs = [0.0; 4]);
    for k in 0..3 {
        solve(simd, tree, Some((node, k)));
        tree.nodes[..tree.dynamic].iter_mut().for_each(|node| node.answers[k] = node.dv);
    }
}
