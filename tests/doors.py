"""What the tests need of the package, in one place: if a module moves, its line here changes.

A name that two modules have is known here under the name of its module, and has its own name again
in a test: ``from doors import gears_reader_load as load``. The public interface is imported from
``planmethod`` itself.
"""

from __future__ import annotations

from planmethod.arguments import UnknownNameError
from planmethod.bench import (
    fairness as checking,
    fairness as confusion,
    measurements as forces,
    measurements as speed,
    report,
)
from planmethod.bench.fairness import Detected, detection, first_items, tasks_of
from planmethod.bench.measurements import Timing, constructed, crank_angles
from planmethod.bench.report import machine_section, speed_section
from planmethod.cams.construction import (
    FREE,
    CamConstruction,
    construct as cams_construction_construct,
)
from planmethod.cams.design import CamDesign, motion_in_division, nearest_to_origin, nodes_of
from planmethod.cams.laws import CamLawName, Reals as LawsReals, UnitLaw, law_of
from planmethod.cams.live import live_page as cams_live_live_page
from planmethod.cams.model import TURN, CamGeometry, CamPhase, CamProblem, Contact
from planmethod.cams.profilepicture import PROFILE
from planmethod.cams.reader import load as cams_reader_load, read_cam
from planmethod.cams.results import CamQuantities, follower_drive
from planmethod.cams.sheet import drawings as cams_sheet_drawings, sheet_scales
from planmethod.cams.text import (
    division_rows,
    given_facts as text_given_facts,
    positions as text_positions,
    positions_title,
)
from planmethod.check import checking as check_group, form, submissions as check_submissions
from planmethod.check.calculation import Calculation, task_of_problem
from planmethod.check.checking import Variants, check, check_works, key_of_problem
from planmethod.check.copies import list_readings, mark_similar_submissions, match_chance
from planmethod.check.exchange.gradebook import feedback_zip, gradebook_csv
from planmethod.check.exchange.quiz import (
    QuizPart,
    escaped,
    gaps_of,
    gift,
    integer_points,
    key_record,
    moodle_xml,
    question_of,
)
from planmethod.check.exchange.responses import is_export, read_columns, read_responses
from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.following import Slip, find_slips, propagate_mistake
from planmethod.check.form import FormHead, describe, fingerprint_of, form_of, list_form_rows
from planmethod.check.grading import (
    ExaminedAnswer,
    assign_verdicts,
    examine as grading_examine,
    replay,
)
from planmethod.check.key import Key, compute_keys, key_of, key_of_task
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
from planmethod.check.measured.drawing import plan_of_layer, read_layers
from planmethod.check.measured.drawing_questions import list_drawing_items
from planmethod.check.measured.plan import open_drawing, read_drawing, variant_of
from planmethod.check.mistakes.plans import MistakeContext
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
from planmethod.check.pages.files import (
    PACKAGES,
    GradingRun,
    anonymous,
    file_names,
    hidden_name,
    run_record,
    settings_rows,
    write_all,
)
from planmethod.check.pages.group import bars, group_html, results_xlsx, statistics_of
from planmethod.check.pages.keypage import KeyPage, key_document, key_pdf, key_xlsx
from planmethod.check.pages.listing import (
    RESULT_COLUMNS as LISTING_COLUMNS,
    OverridesError,
    apply_overrides,
    csv_bytes,
    read_overrides,
    record as listing_record,
    safe,
)
from planmethod.check.pages.overlay import overlays
from planmethod.check.pages.remarks import AnswerFormatter, Remarks
from planmethod.check.pages.student import (
    Page,
    compared_document,
    student_document,
    student_html,
    student_page,
    student_pdf,
)
from planmethod.check.questions import Question, Questions, normalize
from planmethod.check.relations import derived_values, evaluate
from planmethod.check.routes import try_powers
from planmethod.check.sheet import Sheet, single_point
from planmethod.check.simulation import as_written, planted, simulate_submissions
from planmethod.check.submissions import SubmissionError as SubmissionsSubmissionError, read_works
from planmethod.check.submissions.cells import (
    HEADS,
    Cell,
    NotReadError,
    Number as UnitsNumber,
    SubmissionError as FaultsSubmissionError,
    key,
    ratio,
    read_number,
    read_scaled,
    read_sense,
)
from planmethod.check.submissions.gather import read_json
from planmethod.check.submissions.table import read_csv, read_head
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import FOLDED, Tolerance, limit_of as tolerance_limit_of
from planmethod.check.variants import detect_copied_variant
from planmethod.cli import COMMANDS, cli, command_of
from planmethod.commands import batch
from planmethod.commands.batch import BatchOptions, VariantOrder
from planmethod.commands.command import command
from planmethod.commands.lint import LintOptions
from planmethod.commands.output import bar
from planmethod.commands.problems import LoadedProblem, named, run_steps
from planmethod.commands.processes import in_processes
from planmethod.commands.protocol import ProtocolOptions
from planmethod.commands.sheet import SheetOptions
from planmethod.commands.solve import SolveOptions
from planmethod.commands.studio import StudioOptions, settings_of
from planmethod.commands.studio_jobs import LACKING, act
from planmethod.compiled import (
    FEW,
    Runner,
    native,
    runner as compiled_blocks,
    source as pysource,
    tape as symbolic,
)
from planmethod.compiled.native import (
    BLOCK as CSOURCE_BLOCK,
    COMPILERS,
    GUARDS_PER_WORD,
    Native,
    NotCompiledError,
    c_source,
)
from planmethod.compiled.runner import BLOCK as BLOCKS_BLOCK, CACHE_BYTES, MANY, MIN_BLOCK, Blocks
from planmethod.compiled.source import ImpossibleError, straight, used_by
from planmethod.compiled.tape import (
    Guard,
    PiecewiseTape,
    Ref,
    Symbol,
    Symbolic,
    Tape,
    TapeProgram,
    same,
    write as symbolic_write,
)
from planmethod.construct import drafting, evaluate as construct_evaluate, steps
from planmethod.construct.arithmetic import (
    ARRAYS,
    Arithmetic,
    Exact,
    Float64,
    Jet,
    Number as ArithmeticNumber,
    Single,
    unit_vectors,
)
from planmethod.construct.curves import (
    crossings,
    resolved,
    root as curve_root,
    roots,
    roots_between,
    top,
)
from planmethod.construct.drafting import (
    PROFILES as DRAFTING_PROFILES,
    Counted,
    Profile,
    Propagated,
    RulerArithmetic,
    Sampled,
    causes_of,
    sigmas as drawing_sigmas,
)
from planmethod.construct.dual import (
    DIGITS,
    UNIT_ROUNDOFF,
    Dual,
    Duals,
    Precise,
    angle,
    as_dual,
    measured_reach,
    reach,
)
from planmethod.construct.evaluate import (
    Trace,
    evaluate as evaluate_evaluate,
    limit_of as evaluate_limit_of,
    solve_pose,
)
from planmethod.construct.program import Builder, Program, rewritten, substituted
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
    MeasureAngle,
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
from planmethod.defence.case import Case as DefenceCase
from planmethod.defence.document import answers_document, questions_document
from planmethod.defence.model import (
    ChoiceAnswer,
    NumberAnswer,
    Question as DefenceQuestion,
    Subject,
)
from planmethod.defence.moodle import accepted as defence_accepted, moodle_bank
from planmethod.defence.pack import SUBJECTS as defence_subjects, draw_pack  # noqa: N811
from planmethod.defence.places import zone_of
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
from planmethod.gears.axes import solve
from planmethod.gears.coaxiality import derived_teeth
from planmethod.gears.comparison import compare
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
from planmethod.gears.involute import sheet as diagrams
from planmethod.gears.involute.cuttingpicture import (
    ENVELOPE,
    POSITIONS,
    CuttingView,
    cutting_picture,
    cutting_view,
)
from planmethod.gears.involute.formulas import Unit as FormulasUnit
from planmethod.gears.involute.geometry import (
    LineOfAction,
    MeshingProblem,
    Pair,
    Points,
    Rack,
    RackCutting,
    Tooth,
)
from planmethod.gears.involute.live import (
    SCRIPT as MESH_SCRIPT,
    live_page as involute_live_live_page,
)
from planmethod.gears.involute.meshpicture import (
    CURVE as MESHPICTURE_CURVE,
    SCALES as MESHPICTURE_SCALES,
    MeshView,
    mesh_dimensions,
    meshing_picture,
    view_for,
)
from planmethod.gears.involute.reader import load as involute_reader_load
from planmethod.gears.involute.results import (
    LimitKind,
    SolvedMeshing,
    choose as blocking_choose,
    limits,
    meets_limits,
    record as involute_record_record,
    solved_document,
)
from planmethod.gears.involute.sheet import (
    LARGEST_DRAWN_SHIFT,
    SMALLEST_DRAWN_SHIFT,
    Contour,
    Window,
    contour_picture,
    drawings as involute_sheet_drawings,
    working_region,
)
from planmethod.gears.live import live_page as gears_live_live_page
from planmethod.gears.model import (
    GearProblem,
    MeshKind,
    RequestedQuantity,
    RequestedQuantityError,
    Train,
    parse as requested_quantities_parse,
)
from planmethod.gears.motion import (
    ContactKind,
    TrainKind,
    TrainMotion,
    draw,
    mesh_row,
    solve_motion,
    tabular,
)
from planmethod.gears.reader import load as gears_reader_load
from planmethod.gears.record import record as gears_record_record
from planmethod.gears.results import TrainOutput
from planmethod.gears.scheme import (
    Arrangement,
    AxisPart,
    SchemeData,
    arrange,
    best_order,
    scheme_parts,
)
from planmethod.gears.sheet import as_drawn, drawings as gears_sheet_drawings
from planmethod.gears.sheet_texts import results, train_facts
from planmethod.gears.side_view import SideView
from planmethod.gears.solution import (
    Condition,
    answer,
    conditions,
    efficiency,
    judgement,
    max_planets,
    sentence,
)
from planmethod.gears.teeth import SCHEMES, TeethSpecification, TrainScheme
from planmethod.gears.teeth_selection import (
    _mesh_properly,
    choose as teeth_selection_choose,
    problem_text as teeth_report_problem_text,
    set_of,
)
from planmethod.gears.text import equation_of as text_equation_of, stages_of
from planmethod.gears.velocities import by_velocities
from planmethod.gears.views import ARROW_INSIDE, front
from planmethod.kind import ProblemKind
from planmethod.kinds import KINDS as KINDS_KINDS, LINKAGES, kind_of
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
from planmethod.linkages import reading as kinds
from planmethod.linkages.reading import (
    load as kinds_load,
    load_each,
    loads as kinds_loads,
    reading_warnings,
)
from planmethod.linkages.sheets import compacted, sheet_warnings
from planmethod.mechanism.groups import AssurGroup, links_of, triad_of
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import (
    MotionKind,
    PairKind,
    Role,
    Structure,
    analyse,
    kind_of_motion,
    pairs,
    roman,
    stated_pairs,
)
from planmethod.moving.construction import (
    construct as moving_construction_construct,
    drawn_interval,
    read_hodograph,
)
from planmethod.moving.live import SCRIPT as POINT_SCRIPT, live_page as moving_live_live_page
from planmethod.moving.motion import (
    CALLS,
    COLUMNS as MOTION_COLUMNS,
    LEGEND,
    POLAR,
    ROLLED,
    Motion,
    PointProblem,
    Undefined,
    evaluate as series_evaluate,
    move,
    read_formula,
)
from planmethod.moving.pictures import hodograph_picture, trajectory_picture
from planmethod.moving.reader import load as moving_reader_load, loads as reader_loads
from planmethod.moving.results import PointQuantities
from planmethod.moving.sheet import (
    drawings as moving_sheet_drawings,
    sheet_scales as sheet_sheet_scales,
)
from planmethod.moving.text import (
    given_facts as moving_given_facts,
    moment,
    record as moving_record_record,
    textbook,
)
from planmethod.note import document
from planmethod.note.accounts.analytic import AnalyticAccount
from planmethod.note.accounts.machine import MachineAccount, machine_narrator
from planmethod.note.accounts.projections import ForceProjections
from planmethod.note.accounts.voice import STEPS
from planmethod.note.audit import (
    AuditDocument,
    Audited,
    AuditVerdict,
    audit,
    chain,
    count,
    half_digit,
    source_force_scale,
    source_scales,
)
from planmethod.note.calculation.expression import (
    Call,
    Name as ExpressionName,
    Negative,
    Number as ExpressionNumber,
    Operation,
    UnreadableFormulaError,
    evaluate as expression_evaluate,
    read_expression,
)
from planmethod.note.calculation.model import (
    CalculationBuilder,
    LivingCalculation,
    Quantity as ModelQuantity,
)
from planmethod.note.calculation.motion import linkage_chapters
from planmethod.note.calculation.names import NameRegistry, name_of
from planmethod.note.calculation.synthesis import synthesis_chapter
from planmethod.note.columnar import ColumnarRecords, list_of, record_of, to_builtins
from planmethod.note.compared import (
    DASH,
    ComparedNumber,
    measured_series,
    percent_text,
    rounded_to,
    sigma_text,
)
from planmethod.note.document import (
    NO_BREAK,
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
    plain_text,
    step_of,
    table_of,
    table_of_columns,
    table_of_quantities,
)
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
from planmethod.note.narrate.balancing import ReductionNarrator
from planmethod.note.narrate.digits import PrintedNumbers, decimals_of_step, ruler_steps
from planmethod.note.narrate.equations import StatedEquation, stated_equations
from planmethod.note.narrate.forces.lever import LeverNarrator
from planmethod.note.narrate.forces.loads import LoadNarrator, lettered
from planmethod.note.narrate.forces.moments import MomentNarrator
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.forces.statement import (
    cycle_statement,
    force_unknowns,
    largest_symbol,
    statement,
)
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.narrate.naming import (
    Formulas,
    Names,
    detail_view_letter,
    direction_note,
    direction_text,
    mark,
    pair_letters,
    plan_letters,
)
from planmethod.note.narrate.narrator import BoardNarrator, StepNarrator
from planmethod.note.narrate.stated_links import arithmetic
from planmethod.note.narrate.statement import (
    angle_with_positions,
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
from planmethod.note.narrate.synthesis import point_name, size_symbol
from planmethod.note.numbers import Notation, format_column, significant, trimmed
from planmethod.note.protocol import protocol_document
from planmethod.note.records.machine import balancing_record, machine_record
from planmethod.note.records.solution import (
    aligned_record,
    analogue_records,
    batch_records,
    cycle_record,
    record as solution_record,
    record_in_columns,
    structure_in_full,
    structure_record,
)
from planmethod.note.records.spreadsheet import (
    csv_columns,
    csv_rows,
    large_table,
    solved_arrays,
    swept_arrays,
)
from planmethod.note.series import lever_beside_plans
from planmethod.note.synthesis.account import synthesis_document
from planmethod.note.synthesis.drawing import Drawn, construction_of
from planmethod.note.synthesis.formulas import SynthesisFormulas
from planmethod.note.synthesis.text import (
    SynthesisNarrator,
    check_rows,
    set_angle,
    size_rows,
)
from planmethod.note.synthesis.verification import checks, problem_text as verification_problem_text
from planmethod.note.tables.causes import ErrorCauses
from planmethod.note.tables.cycle import cycle_columns, cycle_steps, cycle_tables
from planmethod.note.tables.forces import driven_by, forces_columns, friction_narrator
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
from planmethod.note.writers.formulas import lines_of, pieces, sole_formula, units_of, with_stops
from planmethod.note.writers.html import html_document, markup
from planmethod.note.writers.lowering import (
    Heading,
    LoweredNode,
    NamedFigure,
    Text as LoweredText,
    TextKind,
    lower,
    step_parts,
)
from planmethod.note.writers.markdown import latex, markdown_document
from planmethod.note.writers.pdfformula import ASCENT, DESCENT, FormulaSetter
from planmethod.note.writers.pdfnote import note_fonts, pdf_note
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
from planmethod.note.writers.word_parts import PageFlow, flowing
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.options import (
    DrawingOptions,
    PlanRequest,
    ProblemChoice,
    ResultRequest,
    argument,
    fill_record,
    find_linkage_options,
    option,
)
from planmethod.paper import (
    FORMATS as PAPER_FORMATS,
    Format as PaperFormat,
    paper_format as paper_paper_format,
)
from planmethod.plans import build as plans_build, draft
from planmethod.plans.build import (
    MOTION_KINDS,
    Construction,
    Quantity,
    add_group,
    begin_positions,
    build as build_build,
    kinds_on,
    motion_quantities,
)
from planmethod.plans.diagrams import (
    DiagramAxes,
    DiagramBoard,
    DrawnDiagram,
    Integration,
    differentiate,
    integrate,
    repeated,
)
from planmethod.plans.draft import Draft, cis
from planmethod.plans.forces.board import SCALE, GivenLoad
from planmethod.plans.forces.polygons import (
    DOWN,
    Applied,
    Component,
    Edge,
    ForcePlan,
    LoadKind,
    Shift,
    reaction_symbol,
)
from planmethod.plans.model import (
    FACTS,
    MOTION,
    RATES,
    DimensionKind,
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
from planmethod.plans.motion.legs import Kinematics, letter, slot_name
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
from planmethod.problem.answers import AnswerScope
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode
from planmethod.problem.formula import (
    DEPTH_LIMIT as FORMULA_DEPTH_LIMIT,
    EXPONENT_LIMIT,
    FUNCTIONS,
    LENGTH_LIMIT,
    FormulaError,
    evaluate_arithmetic,
    measured as units_measured,
    read_decimal,
    read_unit,
)
from planmethod.problem.keys import KINDS as KEYS_KINDS, LINK_LIMIT, OF_KINDS, known
from planmethod.problem.machine_records import (
    PROJECT_PARTS,
    CycleTask,
    Differentiation,
    FlywheelMethod,
    FlywheelTask,
    PoleDistances,
    ProjectTask,
    Quadrature,
    WheelShape,
    graph_quantities,
)
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
    OtherDrive,
    OutputPositionKind,
    OutputPositions,
    OutputRate,
    Problem as ModelProblem,
    Rule,
    Scales,
    Slide,
    SynthesisTask,
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
from planmethod.problem.quantities import (
    Analysis,
    QuantityKey,
    QuantityKind,
    QuantityNameError,
    Sign,
    parse_quantity,
    parse_words,
)
from planmethod.problem.reader import apply_variant, read_parsed, read_variants
from planmethod.problem.records import (
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    Against,
    AnswerForm,
    BalancingForceTask,
    Couple,
    DirectionMode,
    Dynamics,
    Fixed,
    FrictionTask,
    Interpolation,
    KindProblem,
    Load,
    Mass,
    MovingSense,
    Over,
    PairFriction,
    Phase,
    Published,
    QuestionSpec,
    SheetSettings,
    SizeTable,
    Spring,
    TurningSense,
)
from planmethod.problem.sheet import VARIABLE, find_config, load_config, usual_place
from planmethod.problem.source import (
    DEPTH_LIMIT as SOURCE_DEPTH_LIMIT,
    LINE_LIMIT,
    SIZE_LIMIT,
    parse as source_parse,
)
from planmethod.problem.tables import (
    SYNTHESIS_KINDS as TABLE_KINDS,
    AngleKey,
    FlagKey,
    IntegerKey,
    NumberKey,
    SynthesisSection,
    TextKey,
    WordKey,
    declared,
)
from planmethod.problem.tasks import (
    FAMILIES as FAMILIES_FAMILIES,
    LINKAGE,
    MACHINES,
    ShippedTask,
    groups_of,
    home,
    tasks,
    template as families_template,
    text_for,
)
from planmethod.problem.toml import table_text
from planmethod.project.calculation import calculation_files, calculation_of
from planmethod.project.notes import NoteOptions, note_files
from planmethod.project.numbers import numbers_workbook
from planmethod.project.parts import PART_KINDS, PartName
from planmethod.project.report import note_document
from planmethod.project.report.context import LETTER, WIDTH as FIGURES_WIDTH, FittedView, Report
from planmethod.project.report.flywheel import flywheel_chapter
from planmethod.project.report.gears import cam_chapter, train_chapter
from planmethod.project.report.note import compared, conclusion
from planmethod.project.settle import (
    Homework,
    Project,
    ProjectPart,
    first_scales,
    in_mesh,
    loaded_positions,
    meshed,
    project_record,
    settle,
    warn_of_separate_train,
    with_decisions,
)
from planmethod.project.sheets import numbered_set, part_drawings, sheet_list
from planmethod.render import symbols
from planmethod.render.backends import BACKENDS, PAGED, Canvas, Options, render, render_pages
from planmethod.render.backends.canvas import LAYERS, arc_curves, layer_of
from planmethod.render.backends.dxf_document import LINE_TYPES, TEXT_STYLE
from planmethod.render.backends.output import cause_of, unwritten, write as output_write
from planmethod.render.backends.view import DrawingView
from planmethod.render.control.remarks import REMARKS, Finding, Severity, obstacle_text, unit_text
from planmethod.render.control.sheet import CELL, inspect, largest_empty, unused_paper
from planmethod.render.control.texts import GRID, lint, misleading, writings_of
from planmethod.render.forces.arrows import (
    ARM,
    Acting,
    ForceArm,
    arm_items,
    distance as arrows_distance,
    on_action,
    place_force_arrows,
)
from planmethod.render.forces.cut import (
    MAX_DISTANCE,
    POINT,
    cut_picture,
    drawn_length,
    inner_picture,
)
from planmethod.render.forces.friction import (
    CIRCLE,
    CONE,
    MIN_RADIUS,
    friction_picture,
    is_enlarged,
)
from planmethod.render.forces.polygon import (
    START,
    drawn_edges,
    find_overlap_shifts,
    lever_picture,
    polar_groups,
    vertex_ellipses,
)
from planmethod.render.frame import (
    ALIASES,
    FORM_1,
    FORM_2,
    FORM_2A,
    FORMATS as FRAME_FORMATS,
    FORMS,
    MARGIN_NOTE,
    SHARED,
    STAMP,
    Form,
    Format as FrameFormat,
    Furniture,
    merged,
    paper_format as frame_paper_format,
    sheet_frame,
    title_block,
)
from planmethod.render.ink.drawing import (
    HEIGHTS,
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
    arc_spans,
    closes,
    dash_spans,
    dashed,
    stroke_lines,
    sweep,
)
from planmethod.render.ink.lettering import (
    FONTS,
    STYLES,
    TYPES as PROPORTIONS_TYPES,
    OutlineLettering,
    in_use,
    lettering,
    lettering_of,
    using,
)
from planmethod.render.ink.pens import ARROW, PENS, Dashes, PenSet, using_pens
from planmethod.render.ink.typeset import (
    PART_OF,
    arc_points,
    index_height,
    ink_bounds,
    line_step,
    overlap,
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
from planmethod.render.labels.model import (
    LED,
    NAMING,
    Floats,
    Label as ModelLabel,
    crossing,
    far_candidates,
    inside,
)
from planmethod.render.layout.block import (
    CUT,
    Alternatives,
    Block,
    Column,
    DrawingArea,
    Lines,
    Picture,
    Row,
    Spacer,
    fit_text,
    heading as block_heading,
    paragraph,
)
from planmethod.render.layout.cuttings import (
    Leaf,
    Unit as CuttingsUnit,
    box_of,
    largest_empty_fraction,
)
from planmethod.render.layout.formula_blocks import equals_at, formula_block, formula_blocks
from planmethod.render.layout.groups import CLEAR, EDGE, GAP, Arrange, Group, LayoutItem
from planmethod.render.layout.pack import on_grid, pack
from planmethod.render.layout.text_blocks import (
    EquationBlock,
    TableCell,
    TableColumn,
    TableForm,
    TablePart,
    equation_block,
    table_block,
)
from planmethod.render.live.animation import Animation, gif, make_animation
from planmethod.render.live.document import joined
from planmethod.render.live.drawn import drawn_model
from planmethod.render.live.page import SCRIPT, live_page as page_live_page
from planmethod.render.live.parts import LINES, parts_of
from planmethod.render.live.scene import LiveScene
from planmethod.render.live.tolerances import TOLERANCE_SHARE, TOLERANCE_SIGMAS
from planmethod.render.pictures.chains import (
    Bar,
    JointEnd,
    SchemeGraph,
    driver_chain,
    embed,
    group_chain,
    mechanism_chain,
    textbook_places,
)
from planmethod.render.pictures.collinear import shifts_apart
from planmethod.render.pictures.diagram import (
    AXIS,
    CURVE as DIAGRAM_CURVE,
    HODOGRAPH,
    POLE as POLAR_POLE,
)
from planmethod.render.pictures.flywheel import construction_picture
from planmethod.render.pictures.kinematic import POINT_TAG, kinematic_picture
from planmethod.render.pictures.lettered import ENLARGED
from planmethod.render.pictures.paths import TRAJECTORY, Paths
from planmethod.render.pictures.planview import (
    CORNER,
    POLE as PLANVIEW_POLE,
    SIGMAS,
    TAG,
    TRACE,
    PictureStyle,
    detail_pictures,
    ellipse,
    ellipse_inscription,
    error_ellipses,
    half_axes,
    plan_picture,
    plan_places,
    plan_traces,
    scheme_traces,
    shown_traces,
    vector_label,
)
from planmethod.render.pictures.scheme import Scheme, off_segment
from planmethod.render.pictures.schemeview import SchemeView, scheme_picture
from planmethod.render.pictures.seriesview import (
    EXTREME,
    POSITION_PRIMES as POSITIONS_PRIMES,
    Positions,
    Thinned,
    construction_items,
    series_picture,
    written as positions_written,
)
from planmethod.render.pictures.structural import (
    Mobile,
    SchemeArea,
    driver_picture,
    group_picture,
    mechanism_picture,
)
from planmethod.render.pictures.supports import free_sides, place_supports
from planmethod.render.play.frames import frames, playback_record
from planmethod.render.play.linkage import linkage_playback
from planmethod.render.play.page import SCRIPT as PLAY_SCRIPT, play_page
from planmethod.render.play.playback import (
    ArcMark,
    Dot,
    Playback,
    PlayedStep,
    Role as PlaybackRole,
    Segment,
    letter_height,
)
from planmethod.render.sheets import (
    blocks as sheets_blocks,
    composition as entries,
    composition as reader,
)
from planmethod.render.sheets.blocks import BLOCKS, maker_of
from planmethod.render.sheets.composer import (
    PageLayout,
    SheetLayout,
    Sizes,
    TrialPaper,
    ViewBlock,
    grow_scales,
)
from planmethod.render.sheets.composition import composition, read_composition, shipped
from planmethod.render.sheets.compositions import SHIPPED, about, shipped_text
from planmethod.render.sheets.controlled import (
    CheckedSheet,
    check_drawings,
    control_text,
    controlled_kinematics,
    controlled_structure,
    paper_of,
)
from planmethod.render.sheets.cycle import cycle_balance_columns
from planmethod.render.sheets.forces import (
    balance_columns,
    guided_at,
    is_couple,
    reaction_columns,
    reactions_block,
)
from planmethod.render.sheets.graphs import graph_groups, graph_picture, load_curves
from planmethod.render.sheets.kinematics import (
    Linkage,
    kinematics_sheets,
    sheet_scales as kinematics_sheet_scales,
)
from planmethod.render.sheets.model import BlockOptions, BlockSpec, BlockStyle, Composition
from planmethod.render.sheets.pages import PageTrial, spread
from planmethod.render.sheets.results import read_names, result_columns
from planmethod.render.sheets.senses import SENSE
from planmethod.render.sheets.specimen import SPECIMENS
from planmethod.render.sheets.specimen.lines import (
    ALPHABETS,
    HEIGHT as LETTERING_HEIGHT,
    SAMPLE as LINES_SAMPLE,
    TYPES as LINES_TYPES,
    LineType,
    lettering_sheet,
    lines_sheet,
    measured_dashes as lines_measured,
    measured_proportions as lettering_measured,
    rule_cells,
    sample,
)
from planmethod.render.sheets.specimen.symbols import (
    HEIGHT as SYMBOLS_HEIGHT,
    WIDTH as SYMBOLS_WIDTH,
    SymbolCell,
    drawn_cell,
    symbol_cells,
)
from planmethod.render.sheets.structure import structure_sheet
from planmethod.render.sheets.synthesis import synthesis_sheet
from planmethod.render.sheets.turn import MAX_SIDE, SMALL as TURN_SMALL, hodograph
from planmethod.render.sheets.views import (
    clear_position,
    clearest_position,
    is_clear,
    plan_spans,
)
from planmethod.render.sketch import VIEWS, assigned, sketch
from planmethod.render.symbols import (
    DIMENSION,
    GROUND as SYMBOLS_GROUND,
    SIZES,
    angle_dimension,
    arrowhead,
    dimension,
    fixed_pivots,
    revolute,
    slider,
    support_half_width,
    turn_arrow,
    vector_arrow,
)
from planmethod.render.symbols.elements import (
    ROLLER,
    SLIDER,
    bell_profile,
    cam,
    carrier_profile,
    mesh_front,
    rack_front,
    rest_on_cam,
    ring_profile,
    wheel_profile,
)
from planmethod.render.symbols.marks import (
    GROUND as HATCHING_GROUND,
    axis_line,
    centre_lines,
    kinked_line,
    pitch_circle,
    wavy_line,
)
from planmethod.scripting.size_fit import FitError
from planmethod.solved import failures as impossible, partial_mechanism
from planmethod.solved.accuracy import examine as accuracy_examine
from planmethod.solved.aligned.poses import poses
from planmethod.solved.aligned.schemes import SelfAligning, constraint_rank, self_aligning
from planmethod.solved.assemblies import Assembled, assemblies, env_of
from planmethod.solved.assembly_modes import choose_modes, construct, construct_each, drive_data
from planmethod.solved.centres import find_centres
from planmethod.solved.cycle_forces import (
    CycleForces,
    DriverPath,
    cycle_efficiency,
    cycle_forces_of,
    without_corners,
)
from planmethod.solved.cycle_motion import CycleMotion
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
    DrawnKind,
    Errors,
    UnknownItemError,
    root_of,
)
from planmethod.solved.extents import OUTLIER, median, sizes, typical
from planmethod.solved.failures import Cause, Contradiction, Doubt, Failure, Place, PositionError
from planmethod.solved.forces.friction import Friction, friction_of, rubbed_reading
from planmethod.solved.forces.loads import Hindrance, applied, external
from planmethod.solved.forces.reading import ForceReading, LeverReading, force_reading
from planmethod.solved.forces.springs import SpringState, spring_states
from planmethod.solved.forces.statics import (
    COMMON_BOX,
    PLACE,
    PLAN_BOX,
    TIMES,
    JointForce,
    Statics,
    distance as contact_distance,
    edge_forces,
    loads_on,
    statics_of,
    transverse_component,
)
from planmethod.solved.legibility import (
    MAX_LABELS,
    NEGLIGIBLE_LENGTH,
    RATIOS,
    SHORT as DETAIL_VIEWS_SHORT,
    SHOWN,
    SIDE,
    SMALL as DETAIL_VIEWS_SMALL,
    Texts,
    circle_radius,
    densest,
    is_too_dense,
    min_enlarged,
)
from planmethod.solved.machine.balancing import Balancing
from planmethod.solved.machine.chain import check_module, machine_chain
from planmethod.solved.machine.drawing import (
    NEAREST_POLE,
    TALLEST,
    FlywheelDrawing,
    drawing_of,
    split,
)
from planmethod.solved.machine.flywheel import (
    RATED_KW,
    WIDEST,
    Flywheel,
    flywheel_of,
    machine_power,
    size_of,
    too_wide,
)
from planmethod.solved.machine.runup import STEADY_SPEED_TOLERANCE, RunUp, StalledError, run_up_of
from planmethod.solved.many import positions as many_positions, variants as varied
from planmethod.solved.many.gapped import CHUNK, GappedSweep
from planmethod.solved.many.positions import (
    BLOCK as POSITIONS_BLOCK,
    SAMPLE as POSITIONS_SAMPLE,
    Gaps,
    evenly,
    examine as positions_examine,
    impossible_steps,
)
from planmethod.solved.many.rows import SweepRow, quantities_for
from planmethod.solved.many.sweep import Sweep, sweep_variants
from planmethod.solved.many.variants import SweepError, Varied, in_batches
from planmethod.solved.partial_mechanism import largest_part
from planmethod.solved.quantities import (
    BOUNDED_KINDS,
    MULTIPLE,
    SCALES as CONDITIONING_SCALES,
    UnknownQuantityError,
    error_bound,
    natural_size,
    quantities_of,
    transfers_of,
)
from planmethod.solved.quantity_steps import NoValue, NoValueError
from planmethod.solved.quantity_values import QuantityValues
from planmethod.solved.reading import Complexes, Reading, Reals as ReadingReals, follower_motion
from planmethod.solved.scaling import AROUND_PLAN, DEAD, FULL
from planmethod.solved.selfcheck import (
    SelfCheckError,
    changed_branches,
    kept_rates,
    motion_doubts,
    verify,
    warnings,
)
from planmethod.solved.solution import UNIT_SCALES, Solution
from planmethod.solved.superposition import parts_by_driver
from planmethod.solved.turn import extremes as numbering
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of
from planmethod.solved.turn.determined import pose, with_drives
from planmethod.solved.turn.diagrams import (
    Diagrams,
    diagrams_of,
    quantities_over,
    sigmas,
    smooth,
    usual_labels,
    values_over,
)
from planmethod.solved.turn.extremes import (
    PRIMES as CONSTRUCTION_PRIMES,
    Locus,
    counting,
    extreme_construction,
    number_positions as number,
    numbered_positions,
    strokes_of,
)
from planmethod.solved.turn.given_rates import find_rates
from planmethod.solved.view_space import Views
from planmethod.studio import door as connections, workers
from planmethod.studio.bank import find_tasks
from planmethod.studio.requests import (
    ACTS,
    LOCAL_LIMITS,
    MB,
    PUBLIC_LIMITS,
    WORKS,
    Bucket,
    StudioLimits,
    StudioRequest,
    build_job,
    place_of,
    request_of,
)
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
from planmethod.synthesis.model import Synthesis, place, scaled
from planmethod.varying.choice import VariantChoice, VariantSearch, choose as choice_choose
from planmethod.varying.evaluation import (
    MIN_LENGTH_MM,
    MIN_MARGIN,
    Rejection,
    RejectionReason,
    evaluator_of,
    free_scales,
    screen_linkages,
)
from planmethod.varying.parameters import (
    _HEADER,
    _LITERAL,
    ValueSampler,
    VariantCandidates,
    coaxial_rows,
    default_keys,
    overrides,
    parse_vary,
    toml_of,
    with_followers,
    without_variants,
)
