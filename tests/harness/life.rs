//! The life of an instance, written down from the standard (FMI 2.0.4, sections 3.2.3 and 4.2.4), apart from what the FMU
//! has in `src/fmi2/calls.rs`.

use super::{Instance, inputs, there};
use split_rotor::abi::{CO_SIMULATION, Choice, MODEL_EXCHANGE, Real, Status};

/// Where an instance can be in its life.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(u8)]
pub enum Stage {
    Instantiated = 1,
    Initialization = 2,
    StepComplete = 4,
    StepFailed = 8,
    EventMode = 16,
    ContinuousTime = 32,
    Terminated = 64,
}

impl Stage {
    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepFailed => "step failed",
            Self::EventMode => "event mode",
            Self::ContinuousTime => "continuous-time mode",
            Self::Terminated => "terminated",
        }
    }

    /// Whether the motion was started.
    pub fn has_started(self) -> bool {
        !matches!(self, Self::Instantiated | Self::Initialization)
    }
}

/// A kind of instance, fmi2Type, and where one is in its life.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Life {
    pub kind: Choice,
    pub stage: Stage,
}

/// A rotor that turns so fast that no step of a millisecond or more can be done, in any scene.
pub const FAST: [(&str, Real); 1] = [("start.omega.y", 1e100)];

impl Life {
    /// All that there are.
    pub const EACH: [Self; 10] = [
        Self::new(CO_SIMULATION, Stage::Instantiated),
        Self::new(CO_SIMULATION, Stage::Initialization),
        Self::new(CO_SIMULATION, Stage::StepComplete),
        Self::new(CO_SIMULATION, Stage::StepFailed),
        Self::new(CO_SIMULATION, Stage::Terminated),
        Self::new(MODEL_EXCHANGE, Stage::Instantiated),
        Self::new(MODEL_EXCHANGE, Stage::Initialization),
        Self::new(MODEL_EXCHANGE, Stage::EventMode),
        Self::new(MODEL_EXCHANGE, Stage::ContinuousTime),
        Self::new(MODEL_EXCHANGE, Stage::Terminated),
    ];

    pub const fn new(kind: Choice, stage: Stage) -> Self {
        Self { kind, stage }
    }

    /// What the kind is called in messages.
    pub fn kind_name(self) -> &'static str {
        if self.kind == MODEL_EXCHANGE { "model exchange" } else { "co-simulation" }
    }

    /// Whether the function of this rule may be called here.
    pub fn allows(self, rule: &Rule) -> bool {
        rule.legal_of(self.kind) & self.stage as u8 != 0
    }

    /// An instance that is there. One that was started went from 0 s to 0.03 s; the one whose step failed is [`FAST`].
    pub fn instance(self) -> Instance {
        let mut instance = Instance::of(self.kind);
        match self.stage {
            Stage::Instantiated => return instance,
            Stage::Initialization => {
                assert_eq!(instance.enter_initialization(), Status::Ok);
                return instance;
            }
            Stage::StepFailed => {
                let mut instance = instance.started(&FAST);
                assert_eq!(instance.do_step(0.0, 1.0), Status::Discard);
                instance.journal.take();
                return instance;
            }
            _ => {}
        }
        instance = instance.started(&[]);
        if self.kind == MODEL_EXCHANGE {
            instance.settled();
            instance.integrate(0.0, 0.001, 30);
        } else {
            instance.run(0.0, 0.01, 3);
        }
        let status = match self.stage {
            Stage::Terminated => instance.terminate(),
            Stage::EventMode => instance.enter_event_mode(),
            _ => Status::Ok,
        };
        assert_eq!(status, Status::Ok);
        instance
    }

    /// The rest of the life of an instance that came from here, in bits.
    pub fn future(self, mut instance: Instance) -> Vec<Vec<u64>> {
        if self.stage == Stage::Instantiated {
            assert_eq!(instance.enter_initialization(), Status::Ok);
        }
        let mut bits = Vec::new();
        let mut from = 0.03;
        match self.stage {
            Stage::Instantiated | Stage::Initialization => {
                assert_eq!(instance.exit_initialization(), Status::Ok, "{:?}", instance.journal.take());
                from = 0.0;
            }
            Stage::StepFailed | Stage::Terminated => {
                bits.push(instance.bits());
                assert_eq!(instance.reset(), Status::Ok);
                instance = instance.started(&[]);
                from = 0.0;
            }
            Stage::StepComplete | Stage::EventMode | Stage::ContinuousTime => {}
        }
        if self.kind == CO_SIMULATION {
            bits.extend(instance.run(from, 0.02, 5));
        } else {
            if self.stage != Stage::ContinuousTime {
                instance.settled();
            }
            bits.extend(instance.integrate(from, 0.001, 20));
        }
        bits
    }
}

/// An instance of either kind on its way, by any method, with an input where the scene has one.
pub struct Traveller {
    pub kind: Choice,
    pub instance: Instance,
}

impl Traveller {
    /// The scene's own start; a damped one; one that tumbles from chart to chart.
    const STARTS: [&[(&'static str, Real)]; 3] = [
        &[],
        &[("support.d1", 30.0), ("support.d2", 0.5)],
        &[("support.c2", 0.0), ("start.gamma.y", 1.9), ("start.omega.x", 1.0), ("start.omega.y", 20.0)],
    ];

    /// After five steps, each kind with each method from each start.
    pub fn all() -> impl Iterator<Item = Self> {
        let kinds = [CO_SIMULATION, MODEL_EXCHANGE].into_iter();
        let ways =
            kinds.flat_map(|kind| (1..=6).flat_map(move |method| Self::STARTS.map(|start| (kind, method, start))));
        // A start is of the values that the scene has.
        ways.map(|(kind, method, start)| {
            let mut instance = Instance::of(kind);
            instance.set_method(method);
            let mut traveller = Self { kind, instance: instance.started(&there(start)) };
            if kind == MODEL_EXCHANGE {
                traveller.instance.settled();
            }
            for input in inputs() {
                assert_eq!(traveller.instance.write(&[input], &[1.5]), Status::Ok);
                let sent = kind == MODEL_EXCHANGE || traveller.instance.send(input, 1, -30.0) == Status::Ok;
                assert!(sent, "a derivative is taken");
            }
            // The solver runs ahead of these steps, so what is saved holds more than they show.
            traveller.step(0.0, 5);
            traveller
        })
    }

    fn step(&mut self, from: Real, count: u32) -> Vec<Vec<u64>> {
        let go = if self.kind == MODEL_EXCHANGE { Instance::integrate } else { Instance::run };
        go(&mut self.instance, from, 2e-3, count)
    }

    /// Ten steps more, in bits.
    pub fn way_on(&mut self) -> Vec<Vec<u64>> {
        self.step(0.01, 10)
    }
}

/// A function that takes an instance and returns a status, and the [`Stage`]s in which it is legal, as sets of bits.
pub struct Rule {
    pub name: &'static str,
    co_simulation: u8,
    model_exchange: u8,
}

impl Rule {
    /// Where it is legal of instances of this kind.
    pub fn legal_of(&self, kind: Choice) -> u8 {
        if kind == MODEL_EXCHANGE { self.model_exchange } else { self.co_simulation }
    }
}

const NEVER: u8 = 0;
const I: u8 = Stage::Instantiated as u8;
const N: u8 = Stage::Initialization as u8;
const S: u8 = Stage::StepComplete as u8;
const F: u8 = Stage::StepFailed as u8;
const E: u8 = Stage::EventMode as u8;
const C: u8 = Stage::ContinuousTime as u8;
const T: u8 = Stage::Terminated as u8;
const CS: u8 = I | N | S | F | T;
const ME: u8 = I | N | E | C | T;

/// Beyond the standard, since hosts do it: variables are read in the state instantiated too; after a step that failed
/// another may be tried, with other inputs; derivatives of outputs are there in initialization mode.
#[rustfmt::skip]
pub static RULES: [Rule; 40] = [
    rule("fmi2SetDebugLogging",               CS, ME),
    rule("fmi2SetupExperiment",               I, I),
    rule("fmi2EnterInitializationMode",       I, I),
    rule("fmi2ExitInitializationMode",        N, N),
    rule("fmi2Terminate",                     S | F, E | C),
    rule("fmi2Reset",                         CS, ME),
    rule("fmi2GetReal",                       CS, ME),
    rule("fmi2GetInteger",                    CS, ME),
    rule("fmi2GetBoolean",                    CS, ME),
    rule("fmi2GetString",                     CS, ME),
    rule("fmi2SetReal",                       I | N | S | F, I | N | E | C),
    // After the initialization only tunable parameters and inputs could be set, of which these types have none.
    rule("fmi2SetInteger",                    I | N, I | N),
    rule("fmi2SetBoolean",                    I | N, I | N),
    rule("fmi2SetString",                     I | N, I | N),
    rule("fmi2GetFMUstate",                   CS, ME),
    rule("fmi2SetFMUstate",                   CS, ME),
    rule("fmi2FreeFMUstate",                  CS, ME),
    rule("fmi2SerializedFMUstateSize",        CS, ME),
    rule("fmi2SerializeFMUstate",             CS, ME),
    rule("fmi2DeSerializeFMUstate",           CS, ME),
    rule("fmi2GetDirectionalDerivative",      N | S | F | T, N | E | C | T),
    rule("fmi2EnterEventMode",                NEVER, C),
    rule("fmi2NewDiscreteStates",             NEVER, E),
    rule("fmi2EnterContinuousTimeMode",       NEVER, E),
    rule("fmi2CompletedIntegratorStep",       NEVER, C),
    rule("fmi2SetTime",                       NEVER, E | C),
    rule("fmi2SetContinuousStates",           NEVER, C),
    rule("fmi2GetDerivatives",                NEVER, N | E | C | T),
    rule("fmi2GetEventIndicators",            NEVER, N | E | C | T),
    rule("fmi2GetContinuousStates",           NEVER, N | E | C | T),
    rule("fmi2GetNominalsOfContinuousStates", NEVER, ME),
    rule("fmi2SetRealInputDerivatives",       I | N | S | F, NEVER),
    rule("fmi2GetRealOutputDerivatives",      N | S | F | T, NEVER),
    rule("fmi2DoStep",                        S | F, NEVER),
    // Legal while a step is under way, which no other call can see; but its refusal gives the reason, not the state.
    rule("fmi2CancelStep",                    CS, NEVER),
    rule("fmi2GetStatus",                     S | F | T, NEVER),
    rule("fmi2GetRealStatus",                 S | F | T, NEVER),
    rule("fmi2GetIntegerStatus",              S | F | T, NEVER),
    rule("fmi2GetBooleanStatus",              S | F | T, NEVER),
    rule("fmi2GetStringStatus",               S | F | T, NEVER),
];

const fn rule(name: &'static str, co_simulation: u8, model_exchange: u8) -> Rule {
    Rule { name, co_simulation, model_exchange }
}
