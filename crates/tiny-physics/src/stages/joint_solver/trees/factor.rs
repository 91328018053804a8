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

use crate::dynamics::{JointTree, NULL, TreeLink, TreeNode, TreeRow};

/// Rows of a link: the rigid ones, then the limit that holds.
#[inline(always)]
fn row_count(link: &TreeLink) -> usize {
    link.rigid + usize::from(link.limit != 0.0)
}

/// Jacobian of a row on body B, or on body A.
#[inline(always)]
pub(super) fn jacobian(row: &TreeRow, on_b: bool) -> [f64; 3] {
    row.on[usize::from(on_b)]
}

/// Jacobian of row `i` of a link, the limit among them.
#[inline(always)]
fn row(link: &TreeLink, i: usize, on_b: bool) -> [f64; 3] {
    if i < link.rigid {
        jacobian(&link.rows[i], on_b)
    } else {
        jacobian(&link.coordinate, on_b).map(|x| link.limit * x)
    }
}

/// A symmetric matrix times a vector; xx, xy, xz, yy, yz, zz.
#[inline(always)]
pub(super) fn times(m: &[f64; 6], v: [f64; 3]) -> [f64; 3] {
    [
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
        m[2] * v[0] + m[4] * v[1] + m[5] * v[2],
    ]
}

#[inline(always)]
pub(super) fn dot3(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The inverse of a symmetric matrix of `n` rows, which are the first; zero where it has none.
#[inline(always)]
pub(super) fn invert(m: &[f64; 6], n: usize) -> [f64; 6] {
    let reciprocal = |x: f64| if x > 0.0 { 1.0 / x } else { 0.0 };
    match n {
        0 => [0.0; 6],
        1 => [reciprocal(m[0]), 0.0, 0.0, 0.0, 0.0, 0.0],
        2 => {
            let inv = reciprocal(m[0] * m[3] - m[1] * m[1]);
            [m[3] * inv, -m[1] * inv, 0.0, m[0] * inv, 0.0, 0.0]
        }
        _ => {
            let c0 = m[3] * m[5] - m[4] * m[4];
            let c1 = m[2] * m[4] - m[1] * m[5];
            let c2 = m[1] * m[4] - m[2] * m[3];
            let inv = reciprocal(m[0] * c0 + m[1] * c1 + m[2] * c2);
            [
                c0 * inv,
                c1 * inv,
                c2 * inv,
                (m[0] * m[5] - m[2] * m[2]) * inv,
                (m[1] * m[2] - m[0] * m[4]) * inv,
                (m[0] * m[3] - m[1] * m[1]) * inv,
            ]
        }
    }
}

/// Mass matrix of a body. What nothing moves in a direction is `heavy` there.
fn mass(node: &TreeNode, heavy: f64) -> [f64; 6] {
    let invert = |inv: f64| if inv > 0.0 { 1.0 / inv } else { heavy };
    let m = invert(node.inv_mass);
    [m, 0.0, 0.0, m, 0.0, invert(node.inv_inertia)]
}

/// A mass and moment of inertia that the bodies of the tree cannot move.
fn heavy(nodes: &[TreeNode]) -> f64 {
    const MORE: f64 = 1.0e9;
    let mut least = f64::MAX;
    for inv in nodes.iter().flat_map(|node| [node.inv_mass, node.inv_inertia]) {
        least = if inv > 0.0 && inv < least { inv } else { least };
    }
    if least < f64::MAX { MORE / least } else { 1.0 }
}

/// Factors the matrix of a tree, unless that is done.
pub(super) fn refactor(tree: &mut JointTree) {
    if !core::mem::replace(&mut tree.factored, true) {
        factor(tree);
    }
}

/// Factors the matrix of a tree.
pub(super) fn factor(tree: &mut JointTree) {
    let JointTree { nodes, dynamic, links, .. } = tree;
    let heavy = heavy(&nodes[..*dynamic]);
    for node in &mut nodes[..*dynamic] {
        node.hat = mass(node, heavy);
    }
    let rooted = links.first().is_some_and(|link| link.parent == NULL);
    for link in links.iter_mut().rev() {
        match row_count(link) {
            0 => factor_link::<0>(nodes, link),
            1 => factor_link::<1>(nodes, link),
            2 => factor_link::<2>(nodes, link),
            _ => factor_link::<3>(nodes, link),
        }
    }
    if !rooted {
        nodes[0].hat = invert(&nodes[0].hat, 3);
    }
}

/// Place of (i, j), i <= j, in a symmetric matrix.
pub(super) const PLACE: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

#[inline(always)]
fn factor_link<const N: usize>(nodes: &mut [TreeNode], link: &mut TreeLink) {
    let mut d = [0.0; 6];
    if link.child != NULL {
        let node = &mut nodes[link.child as usize];
        node.hat = invert(&node.hat, 3);
        let on_b = link.child == link.b;
        let jacobians: [[f64; 3]; N] = core::array::from_fn(|i| row(link, i, on_b));
        for i in 0..N {
            let response = times(&node.hat, jacobians[i]);
            for (j, jacobian) in jacobians.iter().enumerate().skip(i) {
                d[PLACE[i][j]] = dot3(response, *jacobian);
            }
        }
    }
    for i in 0..N {
        let row = if i < link.rigid { &link.rows[i] } else { &link.coordinate };
        d[PLACE[i][i]] += row.compliance;
    }
    link.inverse = invert(&d, N);
    if link.parent != NULL {
        let on_b = link.parent == link.b;
        let jacobians: [[f64; 3]; N] = core::array::from_fn(|i| row(link, i, on_b));
        let hat = &mut nodes[link.parent as usize].hat;
        for i in 0..N {
            let mut column = [0.0; 3];
            for (j, jacobian) in jacobians.iter().enumerate() {
                let factor = link.inverse[PLACE[i][j]];
                for k in 0..3 {
                    column[k] += factor * jacobian[k];
                }
            }
            let own = jacobians[i];
            hat[0] += own[0] * column[0];
            hat[1] += own[0] * column[1];
            hat[2] += own[0] * column[2];
            hat[3] += own[1] * column[1];
            hat[4] += own[1] * column[2];
            hat[5] += own[2] * column[2];
        }
    }
}

/// Solves for the right sides of the links: changes of impulses in the links, of velocities in the nodes.
pub(super) fn solve(tree: &mut JointTree) {
    let JointTree { nodes, dynamic, links, .. } = tree;
    for node in &mut nodes[..*dynamic] {
        node.g = [0.0; 3];
    }
    for link in links.iter_mut().rev() {
        match row_count(link) {
            0 => {}
            1 => gather::<1>(nodes, link),
            2 => gather::<2>(nodes, link),
            _ => gather::<3>(nodes, link),
        }
    }
    if links.first().is_some_and(|link| link.parent != NULL) {
        nodes[0].dv = times(&nodes[0].hat, nodes[0].g);
    }
    for link in links.iter_mut() {
        match row_count(link) {
            0 => scatter::<0>(nodes, link),
            1 => scatter::<1>(nodes, link),
            2 => scatter::<2>(nodes, link),
            _ => scatter::<3>(nodes, link),
        }
    }
}

/// Towards the root: y, and what the parent feels of it.
#[inline(always)]
fn gather<const N: usize>(nodes: &mut [TreeNode], link: &mut TreeLink) {
    if link.child != NULL {
        let node = &nodes[link.child as usize];
        let moved = times(&node.hat, node.g);
        for i in 0..N {
            link.rhs[i] -= dot3(row(link, i, link.child == link.b), moved);
        }
    }
    if link.parent != NULL {
        let push = times(&link.inverse, link.rhs);
        let g = &mut nodes[link.parent as usize].g;
        for (i, push) in push.iter().enumerate().take(N) {
            let jacobian = row(link, i, link.parent == link.b);
            for k in 0..3 {
                g[k] += jacobian[k] * push;
            }
        }
    }
}

/// Away from the root: changes of the impulses and of the child's velocity.
#[inline(always)]
fn scatter<const N: usize>(nodes: &mut [TreeNode], link: &mut TreeLink) {
    if link.parent != NULL {
        let dv = nodes[link.parent as usize].dv;
        for i in 0..N {
            link.rhs[i] -= dot3(row(link, i, link.parent == link.b), dv);
        }
    }
    link.change = times(&link.inverse, link.rhs);
    if link.child != NULL {
        let mut push = nodes[link.child as usize].g;
        for i in 0..N {
            let jacobian = row(link, i, link.child == link.b);
            for k in 0..3 {
                push[k] += jacobian[k] * link.change[i];
            }
        }
        let node = &mut nodes[link.child as usize];
        node.dv = times(&node.hat, push);
    }
}
