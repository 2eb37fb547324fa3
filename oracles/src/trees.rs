//! Rooted trees, and with them every order condition of a Runge–Kutta method.
//!
//! Source: Butcher (1963); Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, section II.2: a
//! method has order p if and only if Σ b_i Φ_i(t) = 1/γ(t) for every rooted tree t of at most p nodes. Check: the known
//! numbers of trees 1, 1, 2, 4, 9, 20, 48, 115 (Cayley 1857) in `tests/exact/numerics.rs`.

/// A rooted tree: the branches at its root.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Tree(Vec<Tree>);

impl Tree {
    /// How many nodes it has.
    pub fn order(&self) -> usize {
        1 + self.0.iter().map(Tree::order).sum::<usize>()
    }

    /// γ(t): the order times the densities of the branches.
    pub fn density(&self) -> f64 {
        self.order() as f64 * self.0.iter().map(Tree::density).product::<f64>()
    }

    /// Φ_i(t) at each stage i of a method with the matrix a.
    pub fn weights(&self, a: &[Vec<f64>]) -> Vec<f64> {
        let mut product = vec![1.0; a.len()];
        for branch in &self.0 {
            let inner = branch.weights(a);
            for (p, row) in product.iter_mut().zip(a) {
                *p *= row.iter().zip(&inner).map(|(a, w)| a * w).sum::<f64>();
            }
        }
        product
    }

    /// Σ |b_i| Φ_i(t) with |a| in place of a, by which rounding is judged.
    pub fn magnitude(&self, a: &[Vec<f64>], b: &[f64]) -> f64 {
        let positive: Vec<Vec<f64>> = a.iter().map(|row| row.iter().map(|x| x.abs()).collect()).collect();
        self.weights(&positive).iter().zip(b).map(|(w, b)| w * b.abs()).sum()
    }
}

/// All trees of up to `order` nodes.
pub fn trees(order: usize) -> Vec<Tree> {
    let mut all: Vec<Tree> = vec![Tree(Vec::new())];
    for n in 2..=order {
        let mut found = Vec::new();
        forests(&all, n - 1, all.len(), &mut Vec::new(), &mut found);
        all.extend(found);
    }
    all
}

/// Every multiset of the first `below` of `known` with `nodes` nodes in all, each made a tree by a root.
fn forests(known: &[Tree], nodes: usize, below: usize, branches: &mut Vec<Tree>, found: &mut Vec<Tree>) {
    if nodes == 0 {
        found.push(Tree(branches.clone()));
        return;
    }
    for i in 0..below {
        if known[i].order() <= nodes {
            branches.push(known[i].clone());
            forests(known, nodes - known[i].order(), i + 1, branches, found);
            branches.pop();
        }
    }
}
