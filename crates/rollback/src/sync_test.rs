//! A session without a network: each frame is undone and played again.

use crate::{Config, Game, PLAYERS, PREDICTION, input_of};
use ggrs::{GgrsError, GgrsRequest, SessionBuilder};

/// What a sync test did.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SyncTest {
    /// Frames of the game.
    pub frames: u32,
    /// Steps of the world, those that were undone counted too.
    pub steps: u64,
    /// Times that the game went back.
    pub rollbacks: u64,
    /// Checksum of the last frame.
    pub checksum: u128,
}

/// Plays so many frames; each goes back [`PREDICTION`] frames and plays them again.
///
/// # Errors
/// `MismatchedChecksum` when a frame did not come out as it did the first time.
pub fn sync_test(mut game: Game, frames: u32, seed: u64) -> Result<SyncTest, GgrsError> {
    let mut session = SessionBuilder::<Config>::new()
        .with_num_players(PLAYERS)?
        .with_max_prediction_window(PREDICTION + 1)
        .with_check_distance(PREDICTION)
        .start_synctest_session()?;
    let mut done = SyncTest { frames, steps: 0, rollbacks: 0, checksum: 0 };
    for frame in 0..frames {
        for player in 0..PLAYERS {
            session.add_local_input(player, input_of(seed, player, frame))?;
        }
        for request in session.advance_frame()? {
            match request {
                GgrsRequest::LoadGameState { .. } => done.rollbacks += 1,
                GgrsRequest::AdvanceFrame { .. } => done.steps += 1,
                GgrsRequest::SaveGameState { .. } => {}
            }
            fulfil(&mut game, request);
        }
    }
    done.checksum = game.checksum();
    Ok(done)
}

/// Does what the session asks for.
pub(crate) fn fulfil(game: &mut Game, request: GgrsRequest<Config>) {
    match request {
        GgrsRequest::SaveGameState { cell, frame } => {
            cell.save(frame, Some(game.save()), Some(game.checksum()));
        }
        GgrsRequest::LoadGameState { cell, .. } => {
            if let Some(frame) = cell.data() {
                game.restore(&frame);
            }
        }
        GgrsRequest::AdvanceFrame { inputs } => {
            let input = |player: usize| inputs.get(player).map_or(0, |(input, _)| *input);
            game.advance(std::array::from_fn(input));
        }
    }
}
