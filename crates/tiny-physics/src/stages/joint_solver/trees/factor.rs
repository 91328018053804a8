//! The equations of a tree of joints, and their solution in linear time.
//!
//! With the masses M of the bodies, Jacobians J, compliance S, right side r, changes dv of velocities and dl of
//! impulses:
//!
//! ```text
//! | M  -J^T | | dv |   | 0 |
//! | J    S  | | dl | = | r |
//! ```
//!
//! Bodies and joints alternate in a tree, so eliminating from the leaves to the root fills nothing in
//! (D. Baraff, "Linear-Time Dynamics using Lagrange Multipliers", 1996; R. Featherstone's articulated-body
//! inertia is the same elimination). For a joint with Jacobians Jc on the child and Jp on the parent,
//!
//! ```text
//! D = Jc Mc^-1 Jc^T + S          Mp <- Mp + Jp^T D^-1 Jp
//! y = r - Jc Mc^-1 gc            gp <- gp + Jp^T D^-1 y
//! ```
//!
//! where Mc and gc have taken up all below the child; then outwards from the root
//! `dl = D^-1 (y - Jp dvp)`, `dvc = Mc^-1 (Jc^T dl + gc)`. An anchor below a node has no child: D = S.
//!
//! Step by step like that, each link waits for eight products of the one before. With `F = Mc^-1 Jc^T D^-1 Jp` ready,
//! how the child follows the parent, it waits for one: `gp <- gp + Jp^T D^-1 r - F^T gc`, `dvc = u - F dvp`, where
//! `u = Mc^-1 (Jc^T D^-1 y + gc)` is needed by nobody else.

use crate::dynamics::{JointTree, NULL, TreeLink, TreeNode, TreeRow};
use crate::simd::{Simd, Three, add_product, add_times, take_product, times};

/// Rows of a link: the rigid ones, then the limit that holds.
#[inline(always)]
pub(super) fn row_count(link: &TreeLink) -> usize {
    link.rigid + usize::from(link.limit != 0.0)
}

/// Not of the fourth, which is none.
#[inline(always)]
pub(super) fn dot3(a: &Three, b: &Three) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The inverse of a symmetric matrix of `n` rows, which are the first; zero where it has none.
#[inline(always)]
pub(super) fn invert(
    [[a, b, c, _], [_, d, e, _], [_, _, f, _]]: &[Three; 3],
    n: usize,
) -> [Three; 3] {
    let reciprocal = |x: f64| if x > 0.0 { 1.0 / x } else { 0.0 };
    match n {
        0 | 1 => [[reciprocal(*a), 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4]],
        2 => {
            let inv = reciprocal(a * d - b * b);
            [[d * inv, -b * inv, 0.0, 0.0], [-b * inv, a * inv, 0.0, 0.0], [0.0; 4]]
        }
        _ => {
            let c0 = d * f - e * e;
            let c1 = c * e - b * f;
            let c2 = b * e - c * d;
            let inv = reciprocal(a * c0 + b * c1 + c * c2);
            let (c0, c1, c2) = (c0 * inv, c1 * inv, c2 * inv);
            let ya = (b * c - a * e) * inv;
            [
                [c0, c1, c2, 0.0],
                [c1, (a * f - c * c) * inv, ya, 0.0],
                [c2, ya, (a * d - b * b) * inv, 0.0],
            ]
        }
    }
}

/// Mass matrix of a body. What nothing moves in a direction is `heavy` there.
fn mass(node: &TreeNode, heavy: f64) -> [Three; 3] {
    let [x, y, inertia, _] = node.inv.map(|inv| if inv > 0.0 { 1.0 / inv } else { heavy });
    [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, inertia, 0.0]]
}

/// A mass and moment of inertia that the bodies of the tree cannot move.
fn heavy(nodes: &[TreeNode]) -> f64 {
    const MORE: f64 = 1.0e9;
    let mut least = f64::MAX;
    for &inv in nodes.iter().flat_map(|node| &node.inv[..3]) {
        least = if inv > 0.0 && inv < least { inv } else { least };
    }
    if least < f64::MAX { MORE / least } else { 1.0 }
}

/// Factors the matrix of a tree without its cuts.
#[inline(always)]
pub(super) fn factor<S: Simd>(simd: S, tree: &mut JointTree) {
    let uncut = tree.uncut();
    let JointTree { nodes, dynamic, links, .. } = tree;
    let free = |node: &TreeNode| node.inv[0] > 0.0 && node.inv[1] > 0.0 && node.inv[2] > 0.0;
    let heavy = if nodes[..*dynamic].iter().all(free) { 0.0 } else { heavy(&nodes[..*dynamic]) };
    for node in &mut nodes[..*dynamic] {
        node.hat = mass(node, heavy);
    }
    let rooted = is_rooted(links);
    for link in links[..uncut].iter_mut().rev() {
        factor_link(simd, nodes, link);
    }
    if !rooted {
        nodes[0].hat = invert(&nodes[0].hat, 3);
    }
}

#[inline(always)]
fn factor_link<S: Simd>(simd: S, nodes: &mut [TreeNode], link: &mut TreeLink) {
    write_limit(link);
    let count = row_count(link);
    let (mut d, mut given, mut felt) = ([[0.0; 4]; 3], [[0.0; 4]; 3], [[0.0; 4]; 3]);
    if link.child != NULL {
        let node = &mut nodes[link.child as usize];
        node.hat = invert(&node.hat, 3);
        let jacobian = &link.jacobians[usize::from(link.child == link.b)];
        for k in 0..count {
            given[k] = times(simd, &node.hat, &jacobian.rows[k]);
            d[k] = times(simd, &jacobian.columns, &given[k]);
        }
    }
    for (k, d) in d.iter_mut().enumerate().take(count) {
        d[k] += link.compliance[k];
    }
    link.inverse = invert(&d, count);
    if link.parent != NULL {
        let rows = &link.jacobians[usize::from(link.parent == link.b)].rows;
        let hat = &mut nodes[link.parent as usize].hat;
        for k in 0..count {
            felt[k] = times(simd, rows, &link.inverse[k]);
            for (hat, x) in hat.iter_mut().zip(&rows[k]) {
                add_times(simd, hat, &felt[k], *x);
            }
        }
        let across = |of: &[Three; 3], k: usize| [of[0][k], of[1][k], of[2][k], 0.0];
        for k in 0..3 {
            link.follow.rows[k] = times(simd, &felt, &across(&given, k));
        }
        for k in 0..3 {
            link.follow.columns[k] = across(&link.follow.rows, k);
        }
    }
    (link.given, link.felt) = (given, felt);
}

/// The row of the limit or motor that holds; zero where none does.
#[inline(always)]
pub(super) fn write_limit(link: &mut TreeLink) {
    let i = link.rigid;
    if i < 3 && (link.limit != 0.0 || link.jacobians[1].rows[i] != [0.0; 4]) {
        let row = if link.driven { &link.drive } else { &link.coordinate };
        let on = row.on.map(|side| side.map(|x| link.limit * x));
        link.set_row(i, &TreeRow { on, error: 0.0, ..*row });
    }
}

/// Solves for the right sides of the links, without its cuts, and what acts on the nodes (in `g`): changes of impulses in the links, of
/// velocities in the nodes.
#[inline(always)]
pub(super) fn solve<S: Simd>(simd: S, tree: &mut JointTree) {
    let uncut = tree.uncut();
    for link in tree.links[..uncut].iter_mut().rev() {
        gather(simd, &mut tree.nodes, link);
    }
    move_root(simd, tree);
    for link in &mut tree.links[..uncut] {
        scatter(simd, &mut tree.nodes, link);
    }
}

/// Works out the answers of all nodes to impulses of one on a node.
#[inline(always)]
pub(super) fn answer<S: Simd>(simd: S, tree: &mut JointTree, node: u32) {
    let JointTree { nodes, dynamic, links, .. } = tree;
    nodes[..*dynamic].iter_mut().for_each(|node| node.answers = [[0.0; 4]; 3]);
    let mut felt: [Three; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    // Nothing is felt but on the way to the root. Links are in the order of their children; the root has one if it has an anchor.
    let (mut at, first) = (node as usize, usize::from(!is_rooted(links)));
    while let Some(TreeNode { hat, answers, .. }) = nodes.get_mut(at) {
        let link = at.checked_sub(first).and_then(|at| links.get(at));
        for (felt, dv) in felt.iter_mut().zip(answers) {
            *dv = times(simd, hat, felt);
            let Some(link) = link else { continue };
            let columns = &link.jacobians[usize::from(link.child == link.b)].columns;
            let held = times(simd, &link.inverse, &times(simd, columns, dv));
            take_product(simd, dv, &link.given, &held);
            *felt = times(simd, &link.follow.rows, felt).map(|x| -x);
        }
        at = link.map_or(NULL, |link| link.parent) as usize;
    }
    for link in links.iter().filter(|link| link.parent != NULL && link.child != NULL) {
        let before = nodes[link.parent as usize].answers;
        for (before, dv) in before.iter().zip(&mut nodes[link.child as usize].answers) {
            take_product(simd, dv, &link.follow.columns, before);
        }
    }
}

/// Has the root an anchor?
fn is_rooted(links: &[TreeLink]) -> bool {
    links.first().is_some_and(|link| link.parent == NULL)
}

/// The change of the root's velocity, if it has no anchor.
#[inline(always)]
fn move_root<S: Simd>(simd: S, JointTree { nodes, links, .. }: &mut JointTree) {
    if !is_rooted(links) {
        nodes[0].dv = times(simd, &nodes[0].hat, &nodes[0].g);
    }
}

/// Towards the root: y, what the parent feels of it, and how the child would move if the parent did not.
#[inline(always)]
fn gather<S: Simd>(simd: S, nodes: &mut [TreeNode], link: &mut TreeLink) {
    let mut push = times(simd, &link.felt, &link.rhs);
    link.change = link.rhs;
    if link.child != NULL {
        let node = &mut nodes[link.child as usize];
        take_product(simd, &mut push, &link.follow.rows, &node.g);
        let columns = &link.jacobians[usize::from(link.child == link.b)].columns;
        node.dv = times(simd, &node.hat, &node.g);
        take_product(simd, &mut link.change, columns, &node.dv);
        add_product(simd, &mut node.dv, &link.given, &times(simd, &link.inverse, &link.change));
    }
    if link.parent != NULL {
        add_times(simd, &mut nodes[link.parent as usize].g, &push, 1.0);
    }
}

/// Away from the root: changes of the child's velocity, and of the impulses.
#[inline(always)]
fn scatter<S: Simd>(simd: S, nodes: &mut [TreeNode], link: &mut TreeLink) {
    if link.parent != NULL {
        let dv = nodes[link.parent as usize].dv;
        let columns = &link.jacobians[usize::from(link.parent == link.b)].columns;
        take_product(simd, &mut link.change, columns, &dv);
        if link.child != NULL {
            take_product(simd, &mut nodes[link.child as usize].dv, &link.follow.columns, &dv);
        }
    }
    link.change = times(simd, &link.inverse, &link.change);
}
