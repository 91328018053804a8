//! Is a tree one?

use super::super::NONE;
use super::super::node_boxes::WIDTH;
use super::DynamicTree;
use crate::math::Aabb;

impl DynamicTree {
    /// Checks every invariant. For tests.
    ///
    /// # Errors
    ///
    /// Says what is wrong, and at which node.
    pub fn validate(&self) -> Result<(), String> {
        let (mut leaves, mut inner) = (0, 0);
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<u32> = [self.root].into_iter().filter(|&root| root != NONE).collect();
        while let Some(index) = stack.pop() {
            let node =
                self.nodes.get(index as usize).ok_or(format!("node {index} is not there"))?;
            inner += 1;
            seen[index as usize] = true;
            let mut count = 0;
            for lane in 0..WIDTH {
                let child = node.child[lane];
                if child == NONE {
                    if self.boxes[index as usize].get(lane) != Aabb::EMPTY
                        || node.category[lane] != 0
                    {
                        return Err(format!("node {index} has something in free lane {lane}"));
                    }
                    continue;
                }
                count += 1;
                if node.level == 0 {
                    leaves += 1;
                    if self.place(child) != Some((index, lane)) {
                        return Err(format!("id {child} does not know its node {index}"));
                    }
                } else {
                    self.validate_link(index, lane)?;
                    stack.push(child);
                }
            }
            if count != node.count || count == 0 {
                return Err(format!("node {index} has {count} children, not {}", node.count));
            }
        }
        let known = self.places.iter().filter(|&&place| place != NONE).count();
        let mut free = self.free;
        while free != NONE {
            inner += 1;
            if core::mem::replace(&mut seen[free as usize], true) {
                return Err(format!("node {free} is free and is not"));
            }
            free = self.nodes[free as usize].parent;
        }
        if leaves != self.count || known != self.count || inner != self.nodes.len() {
            return Err(format!("{leaves} leaves, {inner} nodes, {} boxes", self.count));
        }
        Ok(())
    }

    /// Checks that every link of a tree that was read leads to where it should, so that no walk leaves the
    /// lists or runs in a circle.
    pub(in crate::broad_phase) fn check_loaded(&self) -> Result<(), &'static str> {
        let count = self.nodes.len();
        let inside = |index: u32| index == NONE || (index as usize) < count;
        if self.boxes.len() != count || !inside(self.root) {
            return Err("a tree has no root");
        }
        let is_leaf = |place: u32| (place as usize / WIDTH) < count;
        if self.places.iter().any(|&place| place != NONE && !is_leaf(place)) {
            return Err("a leaf of a tree is nowhere");
        }
        for node in &self.nodes {
            let below = |&child: &u32| child == NONE || node.level == 0 || (child as usize) < count;
            if node.level > 64 || !inside(node.parent) || node.lane as usize >= WIDTH {
                return Err("a node of a tree is wrong");
            }
            if !node.child.iter().all(below) {
                return Err("a branch of a tree leads nowhere");
            }
        }
        let mut free = self.free;
        for _ in 0..=count {
            if free == NONE {
                break;
            }
            free = self.nodes.get(free as usize).ok_or("a free node is nowhere")?.parent;
        }
        if free != NONE {
            return Err("the free nodes of a tree run in a circle");
        }
        // Levels go down by one on each link, so the walk of this ends.
        let root_is_top = self.root == NONE || self.nodes[self.root as usize].parent == NONE;
        if !root_is_top || self.validate().is_err() {
            return Err("a tree is not one");
        }
        Ok(())
    }

    fn validate_link(&self, index: u32, lane: usize) -> Result<(), String> {
        let child = self.nodes[index as usize].child[lane];
        let node = self.nodes.get(child as usize).ok_or(format!("node {child} is not there"))?;
        if (node.parent, node.lane as usize) != (index, lane) {
            return Err(format!("node {child} does not know its parent {index}"));
        }
        if node.level + 1 != self.nodes[index as usize].level {
            return Err(format!("node {child} is on the wrong level"));
        }
        if !self.boxes[index as usize].get(lane).contains(&self.boxes[child as usize].union())
            || self.nodes[index as usize].category[lane] != node.all_categories()
        {
            return Err(format!("node {child} is not in the box its parent has for it"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Boxes, Node};
    use super::*;
    use crate::math::Vec2;

    /// What is handed out again while it holds boxes would be overwritten.
    #[test]
    fn free_nodes_that_are_in_use_are_refused() {
        let mut tree = DynamicTree::new();
        for id in 0..WIDTH as u32 {
            let place = Vec2::new(2.0 * id as f32, 0.0);
            tree.insert(id, Aabb::new(place, place + Vec2::new(1.0, 1.0)), 1);
        }
        assert_eq!(tree.check_loaded(), Ok(()));
        tree.boxes.push(Boxes::EMPTY);
        tree.nodes.push(Node::new(0));
        tree.free = tree.root;
        assert!(tree.check_loaded().is_err());
    }
}
