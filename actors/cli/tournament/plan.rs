//! Who plays whom at which noise.

use super::TournamentArgs;
use hapticbillard::scene::Entrant;
use hapticbillard::tally::SequentialTest;
use hapticbillard_actors::error::Error;

/// One pairing at one noise.
#[derive(Debug, Clone, Copy)]
pub struct Match {
    /// Who plays; the first breaks in the first rack.
    pub players: [Entrant; 2],
    /// Noise of those who have none of their own.
    pub noise: f64,
    /// When it is decided.
    pub until: Option<SequentialTest>,
}

impl Match {
    /// Who plays whom.
    pub fn title(&self) -> String {
        let [one, two] = &self.players;
        format!("{one} : {two}")
    }

    /// The folder of its recordings.
    pub fn file_name(&self) -> String {
        let [one, two] = &self.players;
        format!("{one}-{two}-noise-{}", self.noise).replace('@', "-at-").replace(':', "-")
    }
}

/// Everything that is played.
#[derive(Debug)]
pub struct Plan {
    /// Who takes part.
    pub players: Vec<Entrant>,
    /// Every pairing at the first noise, then at the next.
    pub matches: Vec<Match>,
    racks: u32,
}

impl Plan {
    /// What a command line asks for.
    ///
    /// # Errors
    /// Too few players, one of them twice, or goals that do not fit.
    pub fn new(args: &TournamentArgs) -> Result<Self, Error> {
        let players = args.players.clone();
        if players.len() < 2 {
            let fix = "give two or more, such as club,paper";
            return Err(Error::input("--players", "one player has nobody to play against", fix));
        }
        for (i, player) in players.iter().enumerate() {
            if players[..i].contains(player) {
                let fix = "name each player once";
                return Err(Error::input("--players", format!("{player} is there twice"), fix));
            }
        }
        let pairs: Vec<[Entrant; 2]> = players
            .iter()
            .enumerate()
            .flat_map(|(i, one)| players[i + 1..].iter().map(|two| [*one, *two]))
            .collect();
        let tests = tests(&args.until, pairs.len())?;
        let of_noise = |noise: f64| {
            let tests = tests.iter().copied();
            let pairs = pairs.iter().copied().zip(tests);
            pairs.map(move |(players, until)| Match { players, noise, until }).collect::<Vec<_>>()
        };
        let all = args.noise.iter().flat_map(|noise| of_noise(*noise));
        // Two who bring their own noise play the same racks at any other.
        let is_new = |game: &Match| {
            game.noise == args.noise[0] || game.players.iter().any(|player| player.noise.is_none())
        };
        let matches = all.filter(is_new).collect();
        Ok(Plan { players, matches, racks: args.racks })
    }

    /// How many racks are played if no pairing ends early.
    pub fn racks_at_most(&self) -> u64 {
        self.matches.len() as u64 * u64::from(self.racks)
    }
}

/// The test of each pairing.
fn tests(goals: &[f64], pairs: usize) -> Result<Vec<Option<SequentialTest>>, Error> {
    let test = |goal: f64| {
        SequentialTest::new(goal).ok_or_else(|| {
            let fix = "write a share above 0.05 and below 1, such as 0.8";
            Error::input("--until", format!("{goal} cannot be tested"), fix)
        })
    };
    match goals {
        [] => Ok(vec![None; pairs]),
        [goal] => Ok(vec![Some(test(*goal)?); pairs]),
        goals if goals.len() == pairs => goals.iter().map(|goal| test(*goal).map(Some)).collect(),
        goals => {
            let problem = format!("{} shares for {pairs} pairings", goals.len());
            Err(Error::input("--until", problem, "give one, or one for each pairing"))
        }
    }
}
