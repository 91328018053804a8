//! `rollback`: the game as a test of the engine under rollback netcode.

use clap::{Parser, Subcommand};
use std::error::Error;
use std::time::{Duration, Instant};
use tiny_physics_rollback::{Duel, Game, Network, duel, sync_test};

/// Two players over rollback netcode, with equal checksums throughout.
#[derive(Parser, Debug)]
#[command(after_help = "Examples:
  rollback sync-test --frames 10000
  rollback duel --frames 10000 --delay 50 --jitter 30 --loss 10")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Undo and repeat 8 frames in each frame, without a network
    SyncTest {
        /// Frames of the game
        #[arg(long, default_value_t = 10_000)]
        frames: u32,
        /// Seed of the inputs
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
    /// Two peers over UDP on this machine, through a rough network
    Duel {
        /// Frames of the game
        #[arg(long, default_value_t = 10_000)]
        frames: u32,
        /// Frames a second
        #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1000))]
        rate: u32,
        /// Least delay of a packet, milliseconds
        #[arg(long, default_value_t = 40)]
        delay: u64,
        /// What chance adds to it at most, milliseconds
        #[arg(long, default_value_t = 30)]
        jitter: u64,
        /// Packets lost, per cent
        #[arg(long, default_value_t = 10.0)]
        loss: f32,
        /// Packets that come twice, per cent
        #[arg(long, default_value_t = 2.0)]
        twice: f32,
        /// Seed of inputs and network
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
}

/// Metres a second squared.
const GRAVITY: f32 = 10.0;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let start = Instant::now();
    match Arguments::parse().command {
        Command::SyncTest { frames, seed } => {
            let test = sync_test(Game::new(GRAVITY)?, frames, seed)?;
            println!("{} frames, {} rollbacks, {} steps", test.frames, test.rollbacks, test.steps);
            println!("all checksums equal, the last {:032x}", test.checksum);
        }
        Command::Duel { frames, rate, delay, jitter, loss, twice, seed } => {
            let network = Network {
                delay: Duration::from_millis(delay),
                jitter: Duration::from_millis(jitter),
                loss: 0.01 * loss,
                twice: 0.01 * twice,
            };
            let limit = Duration::from_secs(120) + 10 * frames * (Duration::from_secs(1) / rate);
            let how = Duel { frames, rate, network, seed, limit };
            let report = duel([Game::new(GRAVITY)?, Game::new(GRAVITY)?], &how)?;
            print(&report)?;
        }
    }
    println!("{:.1} s", start.elapsed().as_secs_f32());
    Ok(())
}

fn print(report: &tiny_physics_rollback::Report) -> Result<(), Box<dyn Error + Send + Sync>> {
    for (player, peer) in report.peers.iter().enumerate() {
        println!(
            "peer {player}: {} steps, {} rollbacks, at most {} frames, {} waits, {} packets sent, {} lost, {} received",
            peer.steps,
            peer.rollbacks,
            peer.deepest,
            peer.waits,
            peer.traffic.sent,
            peer.traffic.lost,
            peer.traffic.received
        );
    }
    if let Some(frame) = report.first_difference {
        return Err(format!("the peers differ from frame {frame}").into());
    }
    let desyncs = report.peers[0].desyncs + report.peers[1].desyncs;
    if desyncs > 0 {
        return Err(format!("ggrs found {desyncs} differences").into());
    }
    println!("{} frames with equal checksums on both", report.compared);
    Ok(())
}
