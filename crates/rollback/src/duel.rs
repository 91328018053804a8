//! Two peers, a thread each, over UDP on this machine.

use crate::sync_test::fulfil;
use crate::{Config, Game, Network, PREDICTION, RoughSocket, Traffic, input_of};
use ggrs::{
    DesyncDetection, GgrsError, GgrsEvent, GgrsRequest, P2PSession, PlayerType, SessionBuilder,
};
use std::error::Error;
use std::net::SocketAddr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How a duel goes.
#[derive(Clone, Copy, Debug)]
pub struct Duel {
    /// Frames that both confirm.
    pub frames: u32,
    /// Frames a second.
    pub rate: u32,
    /// What lies between the peers.
    pub network: Network,
    /// Seed of inputs and network.
    pub seed: u64,
    /// When it is given up.
    pub limit: Duration,
}

/// What one peer saw.
#[derive(Clone, Debug, Default)]
pub struct Peer {
    /// Checksum of each frame, the last where a frame was played again.
    pub checksums: Vec<u128>,
    /// Steps of the world, those that were undone counted too.
    pub steps: u64,
    /// Times that it went back, and the most frames at once.
    pub rollbacks: u64,
    /// Most frames that it went back at once.
    pub deepest: u32,
    /// Frames for which it had to wait, too far ahead of the other.
    pub waits: u64,
    /// Differences that ggrs found by itself.
    pub desyncs: u64,
    /// Packets.
    pub traffic: Traffic,
}

/// What came of a duel.
#[derive(Clone, Debug)]
pub struct Report {
    /// Both peers.
    pub peers: [Peer; 2],
    /// Frames whose checksums were compared.
    pub compared: usize,
    /// The first of them that differs.
    pub first_difference: Option<usize>,
}

/// Plays two games against each other until both have confirmed all frames.
///
/// # Errors
/// No socket, an error of ggrs, or the time is up.
pub fn duel(games: [Game; 2], how: &Duel) -> Result<Report, Box<dyn Error + Send + Sync>> {
    let sockets = [
        RoughSocket::open(how.network, how.seed)?,
        RoughSocket::open(how.network, how.seed ^ 0xF00D)?,
    ];
    let addresses = [sockets[0].address()?, sockets[1].address()?];
    let done = AtomicUsize::new(0);
    let outcomes = thread::scope(|scope| {
        let spawn = |(player, (game, socket)): (usize, (Game, RoughSocket))| {
            let (other, done) = (addresses[1 - player], &done);
            scope.spawn(move || Playing::new(player, game, socket, other, how)?.run(how, done))
        };
        let threads: Vec<_> = games.into_iter().zip(sockets).enumerate().map(spawn).collect();
        threads.into_iter().map(thread::ScopedJoinHandle::join).collect::<Vec<_>>()
    });
    let mut peers = Vec::new();
    for outcome in outcomes {
        peers.push(outcome.map_err(|_| "a peer panicked")??);
    }
    let peers: [Peer; 2] = peers.try_into().map_err(|_| "two peers")?;
    let compared = how.frames as usize;
    let unlike = |frame: &usize| peers[0].checksums.get(*frame) != peers[1].checksums.get(*frame);
    let first_difference = (0..compared).find(unlike);
    Ok(Report { peers, compared, first_difference })
}

/// A peer at work.
struct Playing {
    player: usize,
    game: Game,
    session: P2PSession<Config>,
    traffic: Arc<Mutex<Traffic>>,
    peer: Peer,
}

impl Playing {
    fn new(
        player: usize,
        game: Game,
        socket: RoughSocket,
        other: SocketAddr,
        how: &Duel,
    ) -> Result<Self, GgrsError> {
        let traffic = socket.traffic();
        let session = SessionBuilder::<Config>::new()
            .with_num_players(crate::PLAYERS)?
            .with_max_prediction_window(PREDICTION)
            .with_fps(how.rate as usize)?
            .with_desync_detection_mode(DesyncDetection::On { interval: 10 })
            // A machine with much to do may leave a peer alone for a while.
            .with_disconnect_timeout(how.limit)
            .with_disconnect_notify_delay(how.limit)
            .add_player(PlayerType::Local, player)?
            .add_player(PlayerType::Remote(other), 1 - player)?
            .start_p2p_session(socket)?;
        Ok(Self { player, game, session, traffic, peer: Peer::default() })
    }

    /// Plays until both are done: the one that is first goes on, because the other needs its inputs.
    fn run(mut self, how: &Duel, done: &AtomicUsize) -> Result<Peer, Box<dyn Error + Send + Sync>> {
        let (start, tick) = (Instant::now(), Duration::from_secs(1) / how.rate.max(1));
        let (mut next, mut finished, mut skip) = (start, false, 0);
        while done.load(Ordering::SeqCst) < 2 {
            if start.elapsed() > how.limit {
                let frame = self.session.confirmed_frame();
                return Err(format!("the time was up at frame {frame} of {}", how.frames).into());
            }
            self.session.poll_remote_clients();
            skip += self.heed_events();
            if Instant::now() < next {
                thread::sleep(tick.min(Duration::from_millis(1)));
                continue;
            }
            next += tick;
            if skip > 0 {
                skip -= 1;
                continue;
            }
            self.frame(how.seed)?;
            // The frame after the last has been confirmed, so nothing changes the last any more.
            if !finished && self.session.confirmed_frame() > how.frames as i32 {
                finished = true;
                done.fetch_add(1, Ordering::SeqCst);
            }
        }
        self.peer.traffic = *self.traffic.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(self.peer)
    }

    /// Counts what is wrong; gives the frames that ggrs asks to wait.
    fn heed_events(&mut self) -> u32 {
        let mut skip = 0;
        for event in self.session.events() {
            match event {
                GgrsEvent::DesyncDetected { .. } => self.peer.desyncs += 1,
                GgrsEvent::WaitRecommendation { skip_frames } => skip += skip_frames,
                _ => {}
            }
        }
        skip
    }

    fn frame(&mut self, seed: u64) -> Result<(), GgrsError> {
        let frame = self.session.current_frame().max(0) as u32;
        self.session.add_local_input(self.player, input_of(seed, self.player, frame))?;
        let requests = match self.session.advance_frame() {
            Err(GgrsError::NotSynchronized) => return Ok(()),
            Err(GgrsError::PredictionThreshold) => {
                self.peer.waits += 1;
                return Ok(());
            }
            requests => requests?,
        };
        for request in requests {
            self.note(&request, frame);
            fulfil(&mut self.game, request);
        }
        Ok(())
    }

    /// Counts a request; notes the checksum of a frame that is about to be saved.
    fn note(&mut self, request: &GgrsRequest<Config>, now: u32) {
        match request {
            GgrsRequest::SaveGameState { frame, .. } => {
                let frame = (*frame).max(0) as usize;
                self.peer.checksums.truncate(frame);
                self.peer.checksums.push(self.game.checksum());
            }
            GgrsRequest::LoadGameState { frame, .. } => {
                self.peer.rollbacks += 1;
                self.peer.deepest =
                    self.peer.deepest.max(now.saturating_sub((*frame).max(0) as u32));
            }
            GgrsRequest::AdvanceFrame { .. } => self.peer.steps += 1,
        }
    }
}
