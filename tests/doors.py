"""What the tests need of the package, in one place: if a module moves, its line here changes.

A name that two modules have is known here under the name of its module, and has its own name again
in a test: ``from doors import gears_reader_load as load``. The public interface is imported from
``planmethod`` itself.
"""

from __future__ import annotations

from planmethod import kinds
from planmethod.arguments import UnknownNameError
from planmethod.bench import checking, confusion, forces, report, speed
from planmethod.bench.checking import Detected, detection, first_items, tasks_of
from planmethod.bench.cycle import constructed
from planmethod.bench.report import machine_section, speed_section
from planmethod.bench.speed import Timing, crank_angles
from planmethod.cams.construction import (
    FREE,
    CamConstruction,
    construct as cams_construction_construct,
)
from planmethod.cams.design import CamDesign
from planmethod.cams.divisions import motion_in_division, nodes_of
from planmethod.cams.driving import follower_drive
from planmethod.cams.geometry import CamGeometry
from planmethod.cams.laws import CamLawName, Reals as LawsReals, UnitLaw, law_of
from planmethod.cams.live import live_page as cams_live_live_page
from planmethod.cams.model import TURN, CamPhase, CamProblem, Contact
from planmethod.cams.peaks import nearest_to_origin
from planmethod.cams.pictures import PROFILE
from planmethod.cams.question_quantities import CamQuantities
from planmethod.cams.reader import load as cams_reader_load, read_cam
from planmethod.cams.sheet import drawings as cams_sheet_drawings
from planmethod.cams.text import given_facts as text_given_facts, positions as text_positions
from planmethod.check import form, group as check_group, submissions as check_submissions
from planmethod.check.batch import compute_keys
from planmethod.check.calculation import Calculation
from planmethod.check.checking import check
from planmethod.check.copied import detect_copied_variant, mark_similar_submissions, match_chance
from planmethod.check.exchange.cloze import escaped, moodle_xml
from planmethod.check.exchange.gift import gift
from planmethod.check.exchange.gradebook import feedback_zip, gradebook_csv
from planmethod.check.exchange.keyrecord import key_record
from planmethod.check.exchange.quiz import QuizPart, gaps_of, integer_points
from planmethod.check.exchange.responses import is_export, read_columns, read_responses
from planmethod.check.exchange.variant import question_of
from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.following import propagate_mistake
from planmethod.check.form import fingerprint_of, form_of
from planmethod.check.grading import (
    ExaminedAnswer,
    assign_verdicts,
    examine as grading_examine,
    replay,
)
from planmethod.check.group import Variants, check_works, key_of_problem, task_of_problem
from planmethod.check.key import Key, key_of, key_of_task
from planmethod.check.letters import name_and_symbol, normalize
from planmethod.check.marks import (
    DEFAULT,
    KEYS,
    POLICIES,
    PROFILES as MARKS_PROFILES,
    VALUES,
    Settings,
    SettingsError,
    load_settings,
)
from planmethod.check.measured.drawing_questions import list_drawing_items
from planmethod.check.measured.layers import plan_of_layer, read_layers
from planmethod.check.measured.plan import read_drawing
from planmethod.check.mistakes.model import MistakeContext
from planmethod.check.mistakes.scales import scale_by
from planmethod.check.model import (
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    Sense,
    Submission,
    Unread,
    Verdict,
    WrittenAnswer,
)
from planmethod.check.pages import files as check_files
from planmethod.check.pages.answer_format import AnswerFormatter
from planmethod.check.pages.compared import compared_document
from planmethod.check.pages.files import (
    PACKAGES,
    anonymous,
    file_names,
    hidden_name,
    run_record,
    settings_rows,
    write_all,
)
from planmethod.check.pages.grouppage import bars, group_html
from planmethod.check.pages.keypage import KeyPage, key_document, key_pdf, key_xlsx
from planmethod.check.pages.listing import (
    COLUMNS as LISTING_COLUMNS,
    csv_bytes,
    record as listing_record,
    safe,
)
from planmethod.check.pages.overlay import overlays
from planmethod.check.pages.overrides import OverridesError, apply_overrides, read_overrides
from planmethod.check.pages.remarks import Remarks
from planmethod.check.pages.results import results_xlsx
from planmethod.check.pages.statistics import statistics_of
from planmethod.check.pages.student import (
    Page,
    student_document,
    student_html,
    student_page,
    student_pdf,
)
from planmethod.check.questions import Questions, Sign
from planmethod.check.routes import try_powers
from planmethod.check.sheet import Sheet, single_point
from planmethod.check.simulation import as_written, planted, simulate_submissions
from planmethod.check.slips import Slip, slips
from planmethod.check.submissions import SubmissionError as SubmissionsSubmissionError, read_works
from planmethod.check.submissions.answer import NotReadError, read_scaled
from planmethod.check.submissions.cells import HEADS, Cell, key, read_sense
from planmethod.check.submissions.csv_file import read_csv
from planmethod.check.submissions.faults import SubmissionError as FaultsSubmissionError
from planmethod.check.submissions.student import read_json
from planmethod.check.submissions.table import read_head
from planmethod.check.submissions.units import Number as UnitsNumber, ratio, read_number
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import FOLDED, Tolerance, limit_of as tolerance_limit_of
from planmethod.cli import COMMANDS, cli, command_of
from planmethod.commands import batch
from planmethod.commands.batch import VariantOrder
from planmethod.commands.output import bar
from planmethod.commands.problems import LoadedProblem, load_unchanged, named, run_steps
from planmethod.commands.processes import in_processes
from planmethod.commands.sheet import compacted
from planmethod.commands.studio import settings_of
from planmethod.commands.studio_jobs import LACKING, act
from planmethod.compiled import FEW, Runner, blocks as compiled_blocks, native, pysource, symbolic
from planmethod.compiled.blocks import BLOCK as BLOCKS_BLOCK, CACHE_BYTES, MIN_BLOCK, Blocks
from planmethod.compiled.csource import BLOCK as CSOURCE_BLOCK, GUARDS_PER_WORD, c_source
from planmethod.compiled.native import COMPILERS, Native, NotCompiledError
from planmethod.compiled.pysource import ImpossibleError, straight, used_by
from planmethod.compiled.runner import MANY
from planmethod.compiled.symbolic import (
    Guard,
    Symbol,
    Symbolic,
    TapeProgram,
    write as symbolic_write,
)
from planmethod.compiled.tape import Ref, Tape, same
from planmethod.construct import drafting, evaluate as construct_evaluate, steps
from planmethod.construct.arithmetic import (
    Arithmetic,
    Exact,
    Float64,
    Number as ArithmeticNumber,
    Single,
    unit_vectors,
)
from planmethod.construct.condition import UNIT_ROUNDOFF, measured_reach, reach
from planmethod.construct.drafting import (
    PROFILES as DRAFTING_PROFILES,
    Counted,
    Profile,
    Propagated,
    Sampled,
    causes_of,
)
from planmethod.construct.dual import Dual, Duals, angle, as_dual
from planmethod.construct.evaluate import (
    Trace,
    evaluate as evaluate_evaluate,
    limit_of as evaluate_limit_of,
)
from planmethod.construct.jet import Jet
from planmethod.construct.multiprecision import DIGITS, Precise
from planmethod.construct.program import Builder, Program
from planmethod.construct.rewrite import rewritten, substituted
from planmethod.construct.ruler import RulerArithmetic
from planmethod.construct.scale import (
    SERIES as SCALE_SERIES,
    Scale,
    choose_scale,
    next_scale,
    series_near,
)
from planmethod.construct.steps import (
    STEP_TYPES,
    AtAngle,
    Carry,
    Compute,
    GivenNumber,
    GivenPoint,
    IntersectCircles,
    IntersectLineCircle,
    IntersectLines,
    Join,
    LayOffLength,
    Leg,
    LineName,
    LineSense,
    Measure,
    MeasureAlong,
    MeasureArm,
    Name,
    NumberName,
    PointName,
    Side,
    Step as StepsStep,
    Total,
    Touch,
    operands,
    result_kind,
)
from planmethod.construct.triad_pose import solve_pose
from planmethod.errors import (
    ArgumentError,
    AssemblyError,
    CompositionError,
    ConfigError,
    DoubtWarning,
    ExitCode,
    Fault,
    LayoutError,
    OutputError,
    PlanMethodError,
    ProblemError,
    ProgramError,
    StructureError,
)
from planmethod.gears import derivation as gears_derivation
from planmethod.gears.angles import angle_of_involute, involute
from planmethod.gears.answers import answer, efficiency
from planmethod.gears.arrangement import Arrangement, AxisPart, arrange, best_order
from planmethod.gears.comparison import compare
from planmethod.gears.conditions import Condition, conditions, judgement, max_planets, sentence
from planmethod.gears.construction import (
    GearDrawing,
    VelocityDiagramError,
    construct as gears_construction_construct,
    read,
)
from planmethod.gears.derivation import (
    DerivationLine,
    by_speeds,
    derivation as derivation_derivation,
)
from planmethod.gears.drawn.side import SideView
from planmethod.gears.drawn.views import ARROW_INSIDE, front
from planmethod.gears.driving import TrainOutput
from planmethod.gears.involute import diagrams
from planmethod.gears.involute.blocking import (
    LimitKind,
    choose as blocking_choose,
    limits,
    meets_limits,
)
from planmethod.gears.involute.cuttingpicture import (
    ENVELOPE,
    POSITIONS,
    CuttingView,
    cutting_picture,
    cutting_view,
)
from planmethod.gears.involute.diagrams import HIGH, LOW, Contour, Window, contour_picture, working
from planmethod.gears.involute.formulas import Unit as FormulasUnit
from planmethod.gears.involute.generation import RackCutting
from planmethod.gears.involute.meshdimensions import mesh_dimensions
from planmethod.gears.involute.meshpicture import (
    CURVE as MESHPICTURE_CURVE,
    SCALES as MESHPICTURE_SCALES,
    MeshView,
    meshing_picture,
    view_for,
)
from planmethod.gears.involute.profile import LineOfAction, Points, Tooth
from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.reader import load as involute_reader_load
from planmethod.gears.involute.record import record as involute_record_record
from planmethod.gears.involute.sheet import drawings as involute_sheet_drawings
from planmethod.gears.involute.sizes import MeshingProblem, Pair, Rack
from planmethod.gears.involute.text import solved_document
from planmethod.gears.linear import solve
from planmethod.gears.live import live_page as gears_live_live_page
from planmethod.gears.model import GearProblem, MeshKind, Train
from planmethod.gears.motion import TrainKind, TrainMotion, solve_motion
from planmethod.gears.reader import load as gears_reader_load
from planmethod.gears.record import record as gears_record_record
from planmethod.gears.requested_quantities import (
    RequestedQuantity,
    RequestedQuantityError,
    parse as requested_quantities_parse,
)
from planmethod.gears.scheme import SchemeData
from planmethod.gears.sheet import as_drawn, drawings as gears_sheet_drawings
from planmethod.gears.sheet_texts import results, train_facts
from planmethod.gears.teeth import SCHEMES, TeethSpecification, TrainScheme
from planmethod.gears.teeth_report import problem_text as teeth_report_problem_text
from planmethod.gears.teeth_selection import (
    _mesh_properly,
    choose as teeth_selection_choose,
    set_of,
)
from planmethod.gears.text import equation_of as text_equation_of, tabular
from planmethod.gears.velocities import by_velocities
from planmethod.gears.velocity_diagrams import ContactKind, draw
from planmethod.kinds import (
    KINDS as KINDS_KINDS,
    kind_of,
    load as kinds_load,
    load_each,
    loads as kinds_loads,
)
from planmethod.languages import (
    LANGUAGES as LANGUAGES_LANGUAGES,
    OWN_VARIABLE,
    SYSTEM_VARIABLES,
    WRITTEN,
    catalogue,
    choose_language,
    current_language,
    look_up_translation,
    speaking,
    translate,
    visible,
)
from planmethod.mechanism.describe import (
    MotionKind,
    PairKind,
    Role,
    kind_of_motion,
    pairs,
    stated_pairs,
)
from planmethod.mechanism.groups import AssurGroup, links_of, triad_of
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import Structure, analyse, roman
from planmethod.moving.construction import (
    construct as moving_construction_construct,
    read_hodograph,
)
from planmethod.moving.interval import drawn_interval
from planmethod.moving.model import PointProblem, read_formula
from planmethod.moving.motion import (
    COLUMNS as MOTION_COLUMNS,
    LEGEND,
    POLAR,
    ROLLED,
    Motion,
    Undefined,
    move,
)
from planmethod.moving.pictures import hodograph_picture, trajectory_picture
from planmethod.moving.question_quantities import PointQuantities
from planmethod.moving.reader import load as moving_reader_load, loads as reader_loads
from planmethod.moving.record import record as moving_record_record
from planmethod.moving.series import CALLS, evaluate as series_evaluate
from planmethod.moving.sheet import (
    drawings as moving_sheet_drawings,
    sheet_scales as sheet_sheet_scales,
)
from planmethod.moving.text import moment, textbook
from planmethod.note import document
from planmethod.note.audit.audit import (
    AuditDocument,
    Audited,
    AuditVerdict,
    audit,
    count,
    half_digit,
    source_force_scale,
    source_scales,
)
from planmethod.note.audit.machine import chain
from planmethod.note.columnar import ColumnarRecords, list_of, record_of, to_builtins
from planmethod.note.compared import DASH, ComparedNumber, measured_series, percent_text
from planmethod.note.document import (
    Caption,
    Chapter,
    Contents,
    Document,
    DrawableView,
    Equation,
    Equations,
    Figure,
    Formula,
    GivenFact,
    Item as DocumentItem,
    Node,
    Note,
    PageBreak,
    Paragraph,
    Part,
    References,
    Step as DocumentStep,
    StructuralHeading,
    Subpart,
    Table,
    Term,
    Title,
    TitlePage,
    numbers_of,
    step_of,
    table_of,
    table_of_columns,
    table_of_quantities,
)
from planmethod.note.force_series import lever_beside_plans
from planmethod.note.formula import (
    Fraction,
    Index,
    Letters,
    Overline,
    Root,
    escape,
    fraction,
    inline,
    inlined,
    parse as formula_parse,
    root,
    sides,
    written as formula_written,
)
from planmethod.note.narrate.equations import direction_note, equation_of as equations_equation_of
from planmethod.note.narrate.forces.common import lettered
from planmethod.note.narrate.forces.lever import LeverNarrator
from planmethod.note.narrate.forces.loads import LoadNarrator
from planmethod.note.narrate.forces.moments import MomentNarrator
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.forces.statement import cycle_statement, force_unknowns, statement
from planmethod.note.narrate.formulas import detail_view_letter
from planmethod.note.narrate.letters import direction_text, mark, pair_letters, plan_letters
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.narrator import BoardNarrator, StepNarrator
from planmethod.note.narrate.reduction import ReductionNarrator
from planmethod.note.narrate.statement import (
    angle_with_positions,
    arithmetic,
    drawn,
    given_facts as statement_given_facts,
    reported_links,
    reported_points,
    reported_quantities,
)
from planmethod.note.narrate.steps import calculation
from planmethod.note.narrate.structure import (
    aligned_lines,
    group_caption,
    mobility_formulas,
    structure_document,
)
from planmethod.note.numbers import Notation, format_column, significant, trimmed
from planmethod.note.plaintext import NO_BREAK, plain_text
from planmethod.note.protocol import protocol_document
from planmethod.note.records.aligned import aligned_record, structure_in_full
from planmethod.note.records.balancing import balancing_record
from planmethod.note.records.machine import machine_record
from planmethod.note.records.npz import solved_arrays, swept_arrays
from planmethod.note.records.solution import (
    analogue_records,
    batch_records,
    cycle_record,
    record as solution_record,
    record_in_columns,
    structure_record,
)
from planmethod.note.records.spreadsheet import csv_columns, csv_rows, large_table
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.tables.causes import ErrorCauses
from planmethod.note.tables.cycle import cycle_columns, cycle_steps, cycle_tables
from planmethod.note.tables.forces import driven_by, forces_columns
from planmethod.note.tables.friction import friction_narrator
from planmethod.note.tables.machine import machine_narrator
from planmethod.note.tables.referee import examine_results, referee_document, referee_record
from planmethod.note.tables.results import results_document
from planmethod.note.wording import (
    LANGUAGES as WORDING_LANGUAGES,
    Language,
    MessageTable,
    UnknownLanguageError,
    get_language,
    wording,
)
from planmethod.note.writers import omml
from planmethod.note.writers.html import html_document, markup
from planmethod.note.writers.linebreak import lines_of
from planmethod.note.writers.markdown import latex, markdown_document
from planmethod.note.writers.pdfformula import ASCENT, DESCENT, FormulaSetter
from planmethod.note.writers.pdfnote import note_fonts, pdf_note
from planmethod.note.writers.sentences import pieces, sole_formula, units_of, with_stops
from planmethod.note.writers.terminal import (
    WIDTH as TERMINAL_WIDTH,
    columns_text,
    equation_lines,
    pad,
    plain_document,
    table,
    width,
)
from planmethod.note.writers.word import word_document
from planmethod.note.writers.wordpages import NumberedNode, PageFlow, flowing
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.options import drawn_by
from planmethod.paper import (
    FORMATS as PAPER_FORMATS,
    Format as PaperFormat,
    paper_format as paper_paper_format,
)
from planmethod.plans import build as plans_build, draft
from planmethod.plans.build import add_group, begin_positions, build as build_build
from planmethod.plans.diagrams.board import DiagramAxes, DiagramBoard
from planmethod.plans.diagrams.calculus import Integration, differentiate, integrate, repeated
from planmethod.plans.draft import Draft, cis
from planmethod.plans.forces.board import SCALE, GivenLoad
from planmethod.plans.forces.loads import DOWN, Applied, LoadKind, Shift
from planmethod.plans.forces.polygons import Component, Edge, ForcePlan, reaction_symbol
from planmethod.plans.legend import MOTION_KINDS, Quantity, QuantityKind, motion_quantities
from planmethod.plans.model import (
    FACTS,
    MOTION,
    RATES,
    Direction,
    KnownParts,
    PlanKind,
    Relation,
    Vector,
    VectorEquation,
    VectorKind,
    perpendicular_to,
    pole_letter,
    towards,
)
from planmethod.plans.motion.board import letter
from planmethod.plans.motion.legs import Kinematics, slot_name
from planmethod.problem import (
    FAMILIES as PROBLEM_FAMILIES,
    OTHER_FAMILIES,
    Problem as ProblemProblem,
    keys,
    load as problem_load,
    loads as problem_loads,
    template as problem_template,
    variant_names,
)
from planmethod.problem.answers import words_of
from planmethod.problem.common import (
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    AnswerForm,
    DirectionMode,
    KindProblem,
    Published,
    QuestionSpec,
    SheetSettings,
)
from planmethod.problem.cycle_records import (
    PROJECT_PARTS,
    CycleTask,
    Differentiation,
    PoleDistances,
    ProjectTask,
)
from planmethod.problem.families import (
    FAMILIES as FAMILIES_FAMILIES,
    MACHINES,
    template as families_template,
)
from planmethod.problem.file_node import Faults, FileNode
from planmethod.problem.formula import (
    DEPTH_LIMIT as FORMULA_DEPTH_LIMIT,
    EXPONENT_LIMIT,
    FUNCTIONS,
    LENGTH_LIMIT,
    read_decimal,
)
from planmethod.problem.graphs import graph_quantities
from planmethod.problem.key_types import (
    AngleKey,
    FlagKey,
    IntegerKey,
    NumberKey,
    TextKey,
    WordKey,
    declared,
)
from planmethod.problem.keys import KINDS as KEYS_KINDS, LINK_LIMIT, known
from planmethod.problem.load_records import (
    Against,
    BalancingForceTask,
    Couple,
    Dynamics,
    Fixed,
    FrictionTask,
    Interpolation,
    Load,
    Mass,
    MovingSense,
    Over,
    PairFriction,
    Phase,
    SizeTable,
    TurningSense,
)
from planmethod.problem.machine_records import FlywheelMethod, FlywheelTask, Quadrature, WheelShape
from planmethod.problem.model import (
    ANYWHERE,
    FORCE,
    MOMENT,
    PUSH,
    THRUST,
    AssemblyRelation,
    Body,
    CamDrive,
    Convention,
    Drive,
    OutputPositionKind,
    OutputPositions,
    Problem as ModelProblem,
    Rule,
    Scales,
    Slide,
)
from planmethod.problem.names import (
    LOOKALIKES,
    angle_lines,
    describe_lookalikes,
    fold,
    is_label,
    is_point_name,
    looks_latin,
    nearest_name,
    segment,
    split_pair,
)
from planmethod.problem.parameters import Parameters
from planmethod.problem.placement import heading as placement_heading, rotation
from planmethod.problem.plausibility import unlikely
from planmethod.problem.reader import read_parsed
from planmethod.problem.selector import (
    FORCES,
    MACHINE,
    QUANTITIES,
    Selector,
    SelectorError,
    is_force,
    parse_selector,
    unknown_names,
)
from planmethod.problem.sheet import VARIABLE, find_config, load_config, usual_place
from planmethod.problem.source import (
    DEPTH_LIMIT as SOURCE_DEPTH_LIMIT,
    LINE_LIMIT,
    SIZE_LIMIT,
    parse as source_parse,
)
from planmethod.problem.tasks import LINKAGE, ShippedTask, groups_of, home, tasks, text_for
from planmethod.problem.units import measured as units_measured, read_unit
from planmethod.problem.variants import apply_variant, read_variants
from planmethod.project.decided import loaded_positions
from planmethod.project.first import first_scales
from planmethod.project.model import PartName, Project, ProjectPart
from planmethod.project.notes import NoteOptions, note_files
from planmethod.project.numbers import numbers_workbook
from planmethod.project.record import project_record
from planmethod.project.report import note_document
from planmethod.project.report.cams import cam_chapter
from planmethod.project.report.conclusion import conclusion
from planmethod.project.report.context import Report
from planmethod.project.report.figures import LETTER, WIDTH as FIGURES_WIDTH, FittedView
from planmethod.project.report.flywheel import flywheel_chapter
from planmethod.project.report.gears import train_chapter
from planmethod.project.report.results import compared
from planmethod.project.settle import settle, with_decisions
from planmethod.project.sheets import numbered_set, part_drawings, sheet_list
from planmethod.project.train import in_mesh, meshed, warn_of_separate_train
from planmethod.render import symbols
from planmethod.render.backends import BACKENDS, PAGED, Canvas, Options, render, render_pages
from planmethod.render.backends.curves import arc_curves
from planmethod.render.backends.dxf import LINE_TYPES
from planmethod.render.backends.layers import LAYERS, layer_of
from planmethod.render.backends.output import cause_of, unwritten, write as output_write
from planmethod.render.backends.view import DrawingView
from planmethod.render.control.misleading import misleading
from planmethod.render.control.remarks import REMARKS, Finding, Severity, obstacle_text, unit_text
from planmethod.render.control.sheet import inspect, unused_paper
from planmethod.render.control.texts import GRID, lint, writings_of
from planmethod.render.control.unused import CELL, largest_empty
from planmethod.render.forces.arms import ARM, ForceArm, arm_items
from planmethod.render.forces.arrows import Acting, distance as arrows_distance, place_force_arrows
from planmethod.render.forces.cut import cut_picture, inner_picture
from planmethod.render.forces.ellipses import vertex_ellipses
from planmethod.render.forces.friction import (
    CIRCLE,
    CONE,
    MIN_RADIUS,
    friction_picture,
    is_enlarged,
)
from planmethod.render.forces.guides import DIMENSION, MAX_DISTANCE, POINT, drawn_length
from planmethod.render.forces.hodograph import polar_groups
from planmethod.render.forces.leverpicture import lever_picture
from planmethod.render.forces.polygon import START, drawn_edges, find_overlap_shifts
from planmethod.render.frame.forms import FORM_1, FORM_2, FORM_2A, Form
from planmethod.render.frame.frame import (
    FORMATS as FRAME_FORMATS,
    MARGIN_NOTE,
    STAMP,
    Format as FrameFormat,
    paper_format as frame_paper_format,
    sheet_frame,
    title_block,
)
from planmethod.render.frame.furniture import FORMS, DrawingArea, Furniture
from planmethod.render.frame.titleblock import ALIASES, SHARED, merged
from planmethod.render.ink.drawing import (
    VIEW_KINDS,
    Arc,
    Bounds,
    Disc,
    Drawing,
    Fill,
    Ink,
    Item as DrawingItem,
    Pen,
    Span,
    Stroke,
    Text,
    View,
)
from planmethod.render.ink.extent import arc_points, ink_bounds, overlap
from planmethod.render.ink.lettering import (
    FONTS,
    STYLES,
    OutlineLettering,
    in_use,
    lettering,
    using,
)
from planmethod.render.ink.lettering.proportions import TYPES as PROPORTIONS_TYPES
from planmethod.render.ink.style import (
    ARROW,
    HEIGHTS,
    PENS,
    Dashes,
    S,
    arc_spans,
    closes,
    dash_spans,
    dashed,
    stroke_lines,
    sweep,
)
from planmethod.render.ink.typeset import (
    PART_OF,
    index_height,
    line_step,
    smaller_heights,
    split_words,
    text_corners,
    typeset,
    vector_markup,
)
from planmethod.render.labels import (
    SERIES as LABELS_SERIES,
    UNDER_LABEL,
    Label as LabelsLabel,
    LabelStyle,
    Placed,
    paper,
    place_labels,
    segment_label,
)
from planmethod.render.labels.candidates import Floats, crossing, far_candidates, inside
from planmethod.render.labels.model import NAMING, Label as ModelLabel
from planmethod.render.layout.block import (
    CUT,
    Alternatives,
    Block,
    Column,
    Lines,
    Picture,
    Row,
    Spacer,
    fit_text,
    heading as block_heading,
    paragraph,
)
from planmethod.render.layout.cuttings import (
    CLEAR,
    GAP,
    Arrange,
    Group,
    LayoutItem,
    Leaf,
    Unit as CuttingsUnit,
    box_of,
)
from planmethod.render.layout.equations import EquationBlock, equation_block, formula_block
from planmethod.render.layout.grid import on_grid
from planmethod.render.layout.pack import EDGE, largest_empty_fraction, pack
from planmethod.render.layout.tables import TableCell, TableColumn, TablePart, table_block
from planmethod.render.live.animation import make_animation
from planmethod.render.live.page import live_page as page_live_page
from planmethod.render.live.parts import LINES, parts_of
from planmethod.render.live.scene import LiveScene
from planmethod.render.pictures.chains import (
    JointEnd,
    driver_chain,
    group_chain,
    mechanism_chain,
    textbook_places,
)
from planmethod.render.pictures.detail_views import ENLARGED
from planmethod.render.pictures.diagram import AXIS, CURVE as DIAGRAM_CURVE
from planmethod.render.pictures.ellipses import (
    SIGMAS,
    TAG,
    ellipse,
    ellipse_inscription,
    error_ellipses,
    half_axes,
)
from planmethod.render.pictures.embedding import Bar, SchemeGraph, embed
from planmethod.render.pictures.extremes import EXTREME, STROKE, construction_items
from planmethod.render.pictures.flywheel import construction_picture
from planmethod.render.pictures.kinematic import POINT_TAG, kinematic_picture
from planmethod.render.pictures.paths import TRAJECTORY, Paths
from planmethod.render.pictures.planview import (
    POLE as PLANVIEW_POLE,
    detail_pictures,
    plan_picture,
    plan_places,
    vector_label,
)
from planmethod.render.pictures.polar import HODOGRAPH, POLE as POLAR_POLE
from planmethod.render.pictures.positions import (
    PRIMES as POSITIONS_PRIMES,
    Positions,
    Thinned,
    written as positions_written,
)
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.schemeview import SchemeView, scheme_picture
from planmethod.render.pictures.seriesview import series_picture
from planmethod.render.pictures.structural import (
    Mobile,
    driver_picture,
    group_picture,
    mechanism_picture,
)
from planmethod.render.pictures.supports import free_sides, place_supports
from planmethod.render.pictures.traces import (
    CORNER,
    TRACE,
    plan_traces,
    scheme_traces,
    shown_traces,
)
from planmethod.render.sheets import blocks as sheets_blocks
from planmethod.render.sheets.blocks import BLOCKS, maker_of
from planmethod.render.sheets.composer import Sizes, TrialPaper
from planmethod.render.sheets.composition import entries, reader
from planmethod.render.sheets.composition.reader import composition, read_composition, shipped
from planmethod.render.sheets.compositions import SHIPPED, about, shipped_text
from planmethod.render.sheets.control_report import control_text
from planmethod.render.sheets.controlled import (
    CheckedSheet,
    check_drawings,
    controlled_kinematics,
    controlled_structure,
    paper_of,
)
from planmethod.render.sheets.cycletable import cycle_balance_columns
from planmethod.render.sheets.graphs import graph_groups, graph_picture
from planmethod.render.sheets.guides import guided_at, is_couple
from planmethod.render.sheets.kinematics import (
    Linkage,
    kinematics_sheets,
    sheet_scales as kinematics_sheet_scales,
)
from planmethod.render.sheets.loads import load_curves
from planmethod.render.sheets.measured import read_names
from planmethod.render.sheets.model import BlockOptions, BlockSpec, BlockStyle, Composition
from planmethod.render.sheets.pages import pages_of
from planmethod.render.sheets.reactions import (
    balance_columns,
    reaction_columns,
    reactions_block,
)
from planmethod.render.sheets.results import result_columns
from planmethod.render.sheets.specimen import SPECIMENS
from planmethod.render.sheets.specimen.cells import SymbolCell, drawn_cell
from planmethod.render.sheets.specimen.lettering import (
    ALPHABETS,
    HEIGHT as LETTERING_HEIGHT,
    lettering_sheet,
    measured as lettering_measured,
)
from planmethod.render.sheets.specimen.lines import (
    SAMPLE as LINES_SAMPLE,
    TYPES as LINES_TYPES,
    LineType,
    lines_sheet,
    measured as lines_measured,
    rule_cells,
    sample,
)
from planmethod.render.sheets.specimen.symbols import (
    HEIGHT as SYMBOLS_HEIGHT,
    WIDTH as SYMBOLS_WIDTH,
    symbol_cells,
)
from planmethod.render.sheets.structure import structure_sheet
from planmethod.render.sheets.turn import MAX_SIDE, SMALL as TURN_SMALL, hodograph
from planmethod.render.sheets.views import plan_spans
from planmethod.render.sketch import VIEWS, assigned, sketch
from planmethod.render.symbols import (
    GROUND as SYMBOLS_GROUND,
    SIZES,
    arrowhead,
    fixed_pivots,
    revolute,
    slider,
    support_half_width,
    turn_arrow,
    vector_arrow,
)
from planmethod.render.symbols.axes import (
    axis_line,
    centre_lines,
    kinked_line,
    pitch_circle,
    wavy_line,
)
from planmethod.render.symbols.cams import ROLLER, cam, rest_on_cam
from planmethod.render.symbols.gears import (
    bell_profile,
    carrier_profile,
    mesh_front,
    rack_front,
    ring_profile,
    wheel_profile,
)
from planmethod.render.symbols.hatching import GROUND as HATCHING_GROUND
from planmethod.solved import impossible, partial_mechanism
from planmethod.solved.accuracy import examine as accuracy_examine
from planmethod.solved.aligned.poses import poses
from planmethod.solved.aligned.schemes import SelfAligning, constraint_rank, self_aligning
from planmethod.solved.assemblies import Assembled, assemblies, env_of
from planmethod.solved.assembly_modes import choose_modes, drive_data
from planmethod.solved.course.motion import CycleMotion
from planmethod.solved.cycle import Cycle, cycle
from planmethod.solved.detail_views import (
    NEGLIGIBLE_LENGTH,
    RATIOS,
    SHORT as DETAIL_VIEWS_SHORT,
    SHOWN,
    SMALL as DETAIL_VIEWS_SMALL,
    min_enlarged,
)
from planmethod.solved.driver_path import DriverPath, without_corners
from planmethod.solved.driving import follower_motion
from planmethod.solved.efficiency import cycle_efficiency
from planmethod.solved.errors.drawing import DrawnKind
from planmethod.solved.errors.forces import (
    BALANCE,
    DIFFERENCE,
    LEVER,
    DrawnForces,
    all_errors,
    angle_label,
    drawn_forces,
    moment_label,
    size_label,
)
from planmethod.solved.errors.motion import Drafting, drafting_of
from planmethod.solved.errors.spread import (
    DRAWS,
    MAX_MARGIN_SIGMA,
    SHORT as SPREAD_SHORT,
    Errors,
    UnknownItemError,
)
from planmethod.solved.errors.widths import root_of
from planmethod.solved.failures import Cause, Contradiction, Doubt, Failure, Place, PositionError
from planmethod.solved.forces.contact import (
    JointForce,
    distance as contact_distance,
    edge_forces,
    transverse_component,
)
from planmethod.solved.forces.friction import Friction, friction_of, rubbed_reading
from planmethod.solved.forces.lever import LeverReading
from planmethod.solved.forces.leverscale import PLACE, TIMES
from planmethod.solved.forces.loads import applied, external
from planmethod.solved.forces.reading import ForceReading, force_reading
from planmethod.solved.forces.resultants import Hindrance
from planmethod.solved.forces.statics import COMMON_BOX, PLAN_BOX, Statics, loads_on, statics_of
from planmethod.solved.label_density import MAX_LABELS, SIDE, densest, is_too_dense
from planmethod.solved.labelled import quantities_for
from planmethod.solved.machine.balancing import Balancing
from planmethod.solved.machine.drawing import (
    NEAREST_POLE,
    TALLEST,
    FlywheelDrawing,
    drawing_of,
    split,
)
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of
from planmethod.solved.machine.motor import RATED_KW, machine_power
from planmethod.solved.machine.runup import STEADY_SPEED_TOLERANCE, RunUp, StalledError, run_up_of
from planmethod.solved.machine.sizes import WIDEST, size_of, too_wide
from planmethod.solved.many import positions as many_positions, varied
from planmethod.solved.many.gaps import CHUNK, GappedSweep
from planmethod.solved.many.positions import (
    BLOCK as POSITIONS_BLOCK,
    SAMPLE as POSITIONS_SAMPLE,
    Gaps,
    evenly,
    examine as positions_examine,
    impossible_steps,
)
from planmethod.solved.many.rows import SweepRow
from planmethod.solved.many.sweep import Sweep, sweep_variants
from planmethod.solved.many.variants import in_batches
from planmethod.solved.many.varied import SweepError
from planmethod.solved.partial_mechanism import largest_part
from planmethod.solved.quantities import UnknownQuantityError, natural_size, quantities_of
from planmethod.solved.reading import Complexes, Reading, Reals as ReadingReals
from planmethod.solved.representative_position import clear_position, clearest_position
from planmethod.solved.scaling import AROUND_PLAN, DEAD, FULL, Views, median, sizes, typical
from planmethod.solved.selectors.forces import ForceValues
from planmethod.solved.selectors.steps import NoValue, NoValueError
from planmethod.solved.selectors.values import SelectorValues
from planmethod.solved.selfcheck import (
    SelfCheckError,
    changed_branches,
    motion_doubts,
    verify,
    warnings,
)
from planmethod.solved.solution import UNIT_SCALES, Solution
from planmethod.solved.transfers import transfers_of
from planmethod.solved.trust.conditioning import (
    BOUNDED_KINDS,
    MULTIPLE,
    SCALES as CONDITIONING_SCALES,
    error_bound,
)
from planmethod.solved.turn import numbering
from planmethod.solved.turn.construction import (
    PRIMES as CONSTRUCTION_PRIMES,
    Locus,
    extreme_construction,
)
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of
from planmethod.solved.turn.diagrams import Diagrams, diagrams_of, sigmas, smooth
from planmethod.solved.turn.numbering import counting, number, numbered_positions, strokes_of
from planmethod.solved.turn.posed import pose
from planmethod.solved.turn.series import quantities_over, usual_labels, values_over
from planmethod.studio import connections, workers
from planmethod.studio.limits import LOCAL_LIMITS, MB, PUBLIC_LIMITS, Bucket, StudioLimits
from planmethod.studio.places import place_of
from planmethod.studio.requests import ACTS, WORKS, StudioRequest, build_job, request_of
from planmethod.studio.server import StudioSettings, application
from planmethod.studio.serverless import start_studio
from planmethod.studio.sessions import LOCK, PREFIX, Desk, Sessions, StudioSession, served_folder
from planmethod.studio.static_export import (
    CORE,
    LOADED,
    OFFICIAL,
    PACKED,
    VERSION,
    Runtime,
    runtime_of,
    write_studio,
)
from planmethod.studio.workers import Act, Pace, StudioQueue
from planmethod.synthesis import KINDS as SYNTHESIS_KINDS, options_of, synthesize
from planmethod.synthesis.drawing import Drawn
from planmethod.synthesis.model import Synthesis, place, scaled
from planmethod.synthesis.sheet import synthesis_sheet
from planmethod.synthesis.text import (
    SynthesisNarrator,
    check_rows,
    point_name,
    set_angle,
    size_rows,
    synthesis_document,
)
from planmethod.synthesis.verification import checks, problem_text as verification_problem_text
from planmethod.varying.candidates import _HEADER, VariantCandidates, toml_of, without_variants
from planmethod.varying.choice import VariantChoice, choose as choice_choose
from planmethod.varying.evaluation import CandidateEvaluator, free_scales
from planmethod.varying.parameters import (
    _LITERAL,
    ValueSampler,
    default_keys,
    overrides,
    parse_vary,
    with_followers,
)
from planmethod.varying.screening import (
    MIN_LENGTH_MM,
    MIN_MARGIN,
    Rejection,
    RejectionReason,
    screen_linkages,
)
from planmethod.varying.teeth import coaxial_rows
