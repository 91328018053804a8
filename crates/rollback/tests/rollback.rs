//! The game under ggrs, shortened: `rollback sync-test` and `rollback duel` run it at length.

use std::time::Duration;
use tiny_physics_rollback::{Duel, Game, Network, duel, sync_test};

fn game() -> Game {
    Game::new(10.0).expect("a game")
}

fn rough(frames: u32) -> Duel {
    let network = Network {
        delay: Duration::from_millis(8),
        jitter: Duration::from_millis(12),
        loss: 0.1,
        twice: 0.05,
    };
    Duel { frames, rate: 250, network, seed: 7, limit: Duration::from_secs(120) }
}

#[test]
fn eight_frames_of_rollback_in_every_frame() {
    let test = sync_test(game(), 600, 1).expect("equal checksums");
    assert!(test.rollbacks > 580 && test.steps > 8 * 580, "{test:?}");
    // The same as without any rollback.
    let mut plain = game();
    for frame in 0..600 {
        plain.advance([0, 1].map(|player| tiny_physics_rollback::input_of(1, player, frame)));
    }
    assert_eq!(plain.checksum(), test.checksum);
}

#[test]
fn two_peers_agree_over_a_rough_network() {
    let report = duel([game(), game()], &rough(500)).expect("both finish");
    assert_eq!((report.compared, report.first_difference), (500, None));
    for peer in &report.peers {
        assert_eq!(peer.desyncs, 0);
        assert!(peer.rollbacks > 20 && peer.traffic.lost > 20, "{peer:?}");
        assert!(peer.checksums.len() > 500);
    }
}

/// The comparison can fail: a game with another gravity is found out, by us and by ggrs.
#[test]
fn peers_that_differ_are_found() {
    let report =
        duel([game(), Game::new(10.001).expect("a game")], &rough(60)).expect("both finish");
    assert_eq!(report.first_difference, Some(0));
    assert!(report.peers.iter().any(|peer| peer.desyncs > 0));
}
