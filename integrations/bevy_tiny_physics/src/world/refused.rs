//! Who was refused, and when to ask again.

use super::Role;
use bevy_ecs::entity::EntityMapper;
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;

/// Entities that asked to be a body, ground or a character and could not.
#[derive(Clone, Debug, Default)]
pub(crate) struct Refused(BTreeMap<(Role, Entity), Refusal>);

#[derive(Clone, Debug)]
struct Refusal {
    /// What was told.
    text: String,
    /// Has something been taken off it since?
    again: bool,
}

impl Refused {
    /// Notes that an entity was refused. Is that something new?
    pub fn note(&mut self, role: Role, entity: Entity, text: String) -> bool {
        let refusal = Refusal { text: text.clone(), again: false };
        self.0.insert((role, entity), refusal).is_none_or(|before| before.text != text)
    }

    pub fn forget(&mut self, role: Role, entity: Entity) {
        self.0.remove(&(role, entity));
    }

    /// A component was taken off an entity: what was wrong may have been that.
    pub fn ask_again(&mut self, entity: Entity) {
        for role in [Role::Body, Role::Lone, Role::Character] {
            if let Some(refusal) = self.0.get_mut(&(role, entity)) {
                refusal.again = true;
            }
        }
    }

    /// Who is to be asked again: what lost a component or has changed. Those that no longer `ask` to be one are forgotten.
    pub fn asked_again(
        &mut self,
        role: Role,
        asks: impl Fn(Entity) -> bool,
        changed: impl Fn(Entity) -> bool,
    ) -> Vec<Entity> {
        self.0.retain(|key, _| key.0 != role || asks(key.1));
        let refused = self.0.iter_mut().filter(|(key, _)| key.0 == role);
        refused
            .filter_map(|(key, refusal)| {
                let again = core::mem::take(&mut refusal.again);
                (again || changed(key.1)).then_some(key.1)
            })
            .collect()
    }

    pub fn map_entities<M: EntityMapper>(&mut self, mapper: &mut M) {
        let old = core::mem::take(&mut self.0);
        self.0.extend(
            old.into_iter()
                .map(|((role, entity), refusal)| ((role, mapper.get_mapped(entity)), refusal)),
        );
    }
}
