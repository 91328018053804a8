//! The elimination against a dense solver.

use super::loops::{factor, solve};
use crate::dynamics::{JointClass, JointTree, NULL, TreeLink, TreeNode, TreeRow};
use crate::simd::{FourKernel, Simd, SimdLevel, dispatch_fours};

struct FactorAndSolve<'a>(&'a mut JointTree);

impl FourKernel for FactorAndSolve<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        factor(simd, self.0);
        solve(simd, self.0, None);
    }
}

/// Factors and solves, on every level with the same result.
fn factor_and_solve(tree: &mut JointTree) {
    let before = tree.clone();
    dispatch_fours(SimdLevel::detect(), FactorAndSolve(tree));
    for level in SimdLevel::available() {
        let mut other = before.clone();
        dispatch_fours(level, FactorAndSolve(&mut other));
        assert!(other == *tree, "{level}");
    }
}

/// Numbers from a seed.
struct Random(u64);

impl Random {
    /// In 0..1.
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    fn row(&mut self) -> TreeRow {
        let mut number = || self.between(-1.0, 1.0);
        let [x, y, arm_a, arm_b] = [(); 4].map(|()| number());
        TreeRow { on: [[-x, -y, -arm_a, 0.0], [x, y, arm_b, 0.0]], ..TreeRow::default() }
    }
}

/// Masses from a thousandth to a thousand; anchors at the root and elsewhere, on which the last node stands for
/// what does not move.
fn random_tree(random: &mut Random) -> JointTree {
    let mut tree = JointTree::default();
    let count = 1 + random.below(12);
    for _ in 0..=count {
        let inv_mass = 10.0_f64.powf(random.between(-3.0, 3.0));
        let inv_inertia = 10.0_f64.powf(random.between(-3.0, 3.0));
        tree.nodes
            .push(TreeNode { inv: [inv_mass, inv_mass, inv_inertia, 0.0], ..TreeNode::default() });
    }
    let fixed = count as u32;
    tree.nodes[count].inv = [0.0; 4];
    tree.dynamic = count;
    if random.below(2) == 0 {
        add(&mut tree, random, 0, fixed, [0, NULL]);
    }
    for child in 1..count as u32 {
        let parent = random.below(child as usize) as u32;
        add(&mut tree, random, child, parent, [child, parent]);
    }
    for _ in 0..random.below(3) {
        let node = random.below(count) as u32;
        add(&mut tree, random, node, fixed, [NULL, node]);
    }
    for _ in 0..if count > 1 { random.below(4) } else { 0 } {
        let one = random.below(count);
        let other = (one + 1 + random.below(count - 1)) % count;
        add(&mut tree, random, one as u32, other as u32, [NULL; 2]);
    }
    tree
}

fn add(tree: &mut JointTree, random: &mut Random, one: u32, other: u32, [child, parent]: [u32; 2]) {
    let ends = if random.below(2) == 0 { [one, other] } else { [other, one] };
    let ([a, b], class) = (ends, JointClass::Revolute);
    let mut link = TreeLink { class, a, b, child, parent, ..TreeLink::default() };
    link.rigid = 1 + random.below(2);
    link.limit = [0.0, 1.0, -1.0][random.below(3)];
    let mut rows = [(); 4].map(|()| random.row());
    let compliance = random.between(1.0e-3, 1.0);
    rows.iter_mut().for_each(|row| row.compliance = compliance);
    (0..link.rigid).for_each(|i| link.set_row(i, &rows[i]));
    link.coordinate = rows[3];
    link.rhs = [(); 4].map(|()| random.between(-1.0, 1.0));
    tree.links.push(link);
}

/// The rows of a link with the right signs, on A and on B.
fn rows(link: &TreeLink) -> Vec<[[f64; 3]; 2]> {
    let [a, b] = &link.jacobians;
    let mut rows: Vec<_> = (0..link.rigid).map(|i| [a.rows[i], b.rows[i]]).collect();
    if link.limit != 0.0 {
        rows.push(link.coordinate.on.map(|side| side.map(|x| link.limit * x)));
    }
    rows.into_iter().map(|row| row.map(|[x, y, angular, _]| [x, y, angular])).collect()
}

/// All unknowns by Gaussian elimination: velocities of the nodes, then impulses in the order of the links.
fn dense(tree: &JointTree) -> Vec<f64> {
    let moving = 3 * tree.dynamic;
    let constraints: Vec<_> = tree
        .links
        .iter()
        .flat_map(|link| {
            rows(link).into_iter().zip(link.rhs).map(move |(row, rhs)| (link, row, rhs))
        })
        .collect();
    let size = moving + constraints.len();
    let mut matrix = vec![vec![0.0; size + 1]; size];
    for (i, node) in tree.nodes[..tree.dynamic].iter().enumerate() {
        for (k, inv) in node.inv.into_iter().take(3).enumerate() {
            matrix[3 * i + k][3 * i + k] = 1.0 / inv;
        }
    }
    for (i, (link, row, rhs)) in constraints.into_iter().enumerate() {
        let at = moving + i;
        for (end, jacobian) in [link.a, link.b].into_iter().zip(row) {
            if (end as usize) < tree.dynamic {
                for k in 0..3 {
                    matrix[at][3 * end as usize + k] = jacobian[k];
                    matrix[3 * end as usize + k][at] = -jacobian[k];
                }
            }
        }
        matrix[at][at] = link.coordinate.compliance;
        matrix[at][size] = rhs;
    }
    eliminate(matrix)
}

fn eliminate(mut matrix: Vec<Vec<f64>>) -> Vec<f64> {
    let size = matrix.len();
    for column in 0..size {
        let best = (column..size)
            .max_by(|&i, &j| matrix[i][column].abs().total_cmp(&matrix[j][column].abs()))
            .expect("a row");
        matrix.swap(column, best);
        for row in column + 1..size {
            let factor = matrix[row][column] / matrix[column][column];
            let taken = matrix[column].clone();
            for (value, taken) in matrix[row].iter_mut().zip(taken).skip(column) {
                *value -= factor * taken;
            }
        }
    }
    let mut solution = vec![0.0; size];
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size).map(|k| matrix[row][k] * solution[k]).sum();
        solution[row] = (matrix[row][size] - known) / matrix[row][row];
    }
    solution
}

#[test]
fn elimination_agrees_with_a_dense_solver() {
    for seed in 0..500 {
        let mut random = Random(seed);
        let mut tree = random_tree(&mut random);
        let expected = dense(&tree);
        let counts: Vec<usize> = tree.links.iter().map(|link| rows(link).len()).collect();
        factor_and_solve(&mut tree);
        let moving = tree.nodes[..tree.dynamic].iter().flat_map(|node| node.dv.into_iter().take(3));
        let impulses =
            tree.links.iter().zip(counts).flat_map(|(link, n)| link.change.into_iter().take(n));
        let scale = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (found, expected) in moving.chain(impulses).zip(&expected) {
            let error = (found - expected).abs();
            assert!(error < 1e-8 * scale, "seed {seed}: {found} instead of {expected}");
        }
    }
}

#[test]
fn what_nothing_moves_stays() {
    let mut random = Random(3);
    let mut tree = random_tree(&mut random);
    while tree.dynamic < 3 {
        tree = random_tree(&mut random);
    }
    tree.nodes[1].inv[2] = 0.0;
    (tree.nodes[2].inv[0], tree.nodes[2].inv[1]) = (0.0, 0.0);
    factor_and_solve(&mut tree);
    assert!(tree.nodes[1].dv[2].abs() < 1e-6 && tree.nodes[2].dv[0].abs() < 1e-6);
    assert!(tree.nodes.iter().flat_map(|node| node.dv).all(f64::is_finite));
}
