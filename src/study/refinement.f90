!> A study on nested meshes, until the error of one number is as small as asked for.
module gfb_refinement
  use gfb_kinds, only: wp
  use gfb_study_cases, only: all_coefficients, asked_name
  use gfb_quantity, only: quantity_type, place_of
  use gfb_result_names, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_errors, only: error_type
  use gfb_foil_row, only: foil_beam
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_reasons, only: reason_inaccurate
  use gfb_run_context, only: run_context_type
  use gfb_signals, only: stop_agreed
  use gfb_scene, only: scene_type
  use gfb_scene_rules, only: is_symmetric
  use gfb_study, only: study_type
  use gfb_nested_meshes, only: nested_mesh, mesh_words, formal_order, keep_scheme
  use gfb_mesh_sequence, only: mesh_sequence_type, start_sequence
  implicit none (type, external)
  private

  !> The finest mesh's study, and what all meshes say of the number.
  type, extends(study_type), public :: refinement_type
    class(study_type), allocatable :: pattern !! like the studies of the meshes, without an answer
    class(study_type), allocatable, private :: finest
    type(scene_type), private :: mesh         !! the scene on that study's mesh
    type(mesh_sequence_type), private :: sequence
    character(len=:), allocatable, private :: stopped !! why there are no more meshes
    character(len=:), allocatable, private :: beams   !! what beams would do, part of a sentence
  contains
    procedure :: prepare => prepare_refinement, check => check_nothing, solve => refine
    procedure :: write => write_finest, discard => discard_finest
  end type refinement_type

contains

  !> Says what the scene needs on the mesh of its case, and with which meshes the refinement begins;
  !> all of them have the film's weighting of that one.
  subroutine prepare_refinement(self, scene, log)
    class(refinement_type), intent(inout) :: self !! the study that refines
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    class(study_type), allocatable :: study

    self%heading = ''
    allocate (study, mold=self%pattern)
    call study%prepare(scene, log)
    self%mesh = scene
    if (scene%general%analysis%has_film) call keep_scheme(self%mesh)
    self%mesh%mesh = nested_mesh(scene, 0)
    call log%line('accuracy: error of '//asked_name(scene%accuracy)// &
                  ' from meshes that begin with '//mesh_words(self%mesh)// &
                  ' elements and are doubled in each direction')
  end subroutine prepare_refinement

  !> Nothing yet: a coarser mesh than that of the case may fit into memory.
  subroutine check_nothing(self, scene, error)
    class(refinement_type), intent(in) :: self !! the study that refines
    type(scene_type), intent(in) :: scene !! what is asked for
    type(error_type), allocatable, intent(out) :: error !! none
  end subroutine check_nothing

  !> Solves on finer and finer meshes; keeps the finest one's answer.
  !>
  !> Fails when a mesh cannot be made, or the first one needs more memory than there is.
  subroutine refine(self, scene, context, error)
    class(refinement_type), target, intent(inout) :: self !! the study that refines
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type) :: trial
    integer :: number, cost(2)
    logical :: fits

    self%stopped = 'maximum_refinements is '//text(scene%accuracy%maximum_refinements)
    self%beams = ''
    self%sequence = start_sequence(scene%accuracy, formal_order(scene))
    trial = self%mesh
    cost = 0
    do number = 0, scene%accuracy%maximum_refinements
      trial%mesh = nested_mesh(scene, number)
      call take_mesh(self, trial, context%log, fits, error)
      if (allocated(error)) return
      if (.not. fits) exit
      call context%log%heading('mesh '//text(number + 1)//': '//mesh_words(trial)//' elements')
      call solve_mesh(trial, context, self%finest, self%sequence, error)
      if (allocated(error)) return
      cost = cost + [self%finest%iterations, self%finest%factorizations]
      if (stop_agreed() .or. self%sequence%met()) exit
      if (self%beams == '' .and. size(self%sequence%value) == 1) then
        call compare_beams(self%pattern, trial, context, self%sequence, self%beams)
      end if
    end do
    self%finest%iterations = cost(1)
    self%finest%factorizations = cost(2)
    self%unknowns = self%finest%unknowns
    self%iterations = cost(1)
    self%factorizations = cost(2)
    self%converged = self%sequence%met()
    if (self%converged) return
    if (stop_agreed()) then
      call self%reason%stopped()
      return
    end if
    self%reason%code = reason_inaccurate
    self%reason%detail = 'target of '//text(100.0_wp*self%sequence%target, 4)// &
                         ' % not met: it needs '//self%sequence%needs()
  end subroutine refine

  !> Replaces the study by that of a finer mesh, if it fits into memory.
  !>
  !> Fails where the first mesh does not.
  subroutine take_mesh(self, scene, log, fits, error)
    class(refinement_type), target, intent(inout) :: self !! the study that refines
    type(scene_type), intent(in) :: scene !! on the finer mesh
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: fits
    type(error_type), allocatable, intent(out) :: error
    class(study_type), allocatable :: next

    allocate (next, mold=self%pattern)
    call next%prepare(scene, silent(log))
    call next%check(scene, error)
    fits = .not. allocated(error)
    if (fits) then
      if (allocated(self%finest)) call self%finest%discard()
      call move_alloc(next, self%finest)
      self%mesh = scene
    else if (allocated(self%finest)) then
      self%stopped = error%message
      deallocate (error)
    end if
  end subroutine take_mesh

  !> A log without lines.
  function silent(log)
    type(run_log_type), intent(in) :: log
    type(run_log_type) :: silent

    silent = log
    silent%active = .false.
  end function silent

  !> Solves on one mesh and judges its value.
  !>
  !> Fails when the mesh cannot be made.
  subroutine solve_mesh(scene, context, study, sequence, error)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    class(study_type), target, intent(inout) :: study
    type(mesh_sequence_type), intent(inout) :: sequence
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: begun, seconds
    integer :: number

    begun = cpu_seconds()
    call study%solve(scene, context, error)
    if (allocated(error)) return
    seconds = cpu_seconds() - begun
    if (study%converged .and. allocated(study%coefficients)) then
      call sequence%add_coefficients(study%coefficients, 2*size(scene%dynamics%frequencies))
      if (sequence%is_of_many()) call add_result(study%found, all_coefficients, 1.0_wp)
    else if (allocated(sequence%coefficients)) then
      deallocate (sequence%coefficients) ! those of coarser meshes no longer count
    end if
    number = place_of(sequence%name, study%found)
    if (study%converged .and. number > 0) then
      call sequence%add(mesh_words(scene), study%unknowns, seconds, study%found(number))
      call context%log%line(sequence%value_words())
    else
      call sequence%add(mesh_words(scene), study%unknowns, seconds)
      call context%log%line('no '//sequence%name//' on this mesh: only finer ones count')
    end if
  end subroutine solve_mesh

  !> Solves a coarse mesh of shells with beams instead, and says whether they would have done.
  subroutine compare_beams(pattern, scene, context, sequence, words)
    class(study_type), intent(in) :: pattern !! of the study of the shells
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(mesh_sequence_type), intent(in) :: sequence
    character(len=:), allocatable, intent(out) :: words !! part of a sentence

    class(study_type), allocatable, target :: study
    type(run_context_type) :: quiet
    type(scene_type) :: beams
    type(error_type), allocatable :: error
    real(wp) :: off
    integer :: number

    words = ''
    if (sequence%is_of_many()) return
    if (.not. scene%general%analysis%has_film .or. .not. scene%model%foil%has_shell_bumps .or. &
        .not. is_symmetric(scene)) return
    beams = scene
    beams%model%foil = foil_beam
    beams%solver%stability = .false.
    quiet = context
    quiet%log = silent(context%log)
    allocate (study, mold=pattern)
    call study%prepare(beams, quiet%log)
    call study%check(beams, error)
    if (.not. allocated(error)) call study%solve(beams, quiet, error)
    if (allocated(error)) return
    number = 0
    if (study%converged) number = place_of(sequence%name, study%found)
    if (number > 0) then
      off = abs(study%found(number)%number - sequence%value(1))/ &
            max(abs(sequence%value(1)), tiny(1.0_wp))
      words = 'off by '//text(100.0_wp*off, 2)//' % on the first mesh'
      if (off > sequence%target) then
        words = 'beams, '//words//', more than the target; '
      else if (off < 0.5_wp*sequence%target) then
        words = 'beams, though '//words//', less than half the target: foil = ''beam'' would do; '
      else
        words = 'beams, '//words//', not clearly less than the target; '
      end if
      call context%log%line('compared: '//words(:len(words) - 2))
    end if
    call study%discard()
  end subroutine compare_beams

  !> Writes the results of the finest mesh, and says what came out of all.
  !>
  !> Fails when a file cannot be written.
  subroutine write_finest(self, scene, context, summary, error)
    class(refinement_type), target, intent(inout) :: self !! the study that refines
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: left_out

    self%finest%converged = self%converged
    self%finest%reason = self%reason
    self%finest%more = self%sequence%quantities()
    call self%sequence%coefficient_errors(self%finest%coefficient_errors)
    call self%finest%write(self%mesh, context, summary, error)
    if (allocated(error)) return
    left_out = self%finest%left_out(scene)//self%beams//'finer meshes, '
    associate (log => context%log)
      call self%sequence%show(log)
      call log%line(self%sequence%value_words())
      if (scene%general%analysis%has_film .and. scene%model%foil%has_bumps) then
        call log%line('an estimate, no bound: crests ripple the film (manual: accuracy.md)')
      end if
      if (self%converged) then
        call log%line('target of '//text(100.0_wp*self%sequence%target, 4)//' % met; left out: '// &
                      left_out//'which the target does not need')
      else
        call log%tell(self%reason%words())
        call log%line('left out: '//left_out//'because '//self%stopped)
      end if
    end associate
  end subroutine write_finest

  !> Frees what the solvers hold.
  subroutine discard_finest(self)
    class(refinement_type), intent(inout) :: self !! the study that refines
    if (allocated(self%finest)) call self%finest%discard()
  end subroutine discard_finest

  !> CPU time of all ranks [s].
  real(wp) function cpu_seconds() result(seconds)
    real(wp) :: all_ranks(1)

    call cpu_time(seconds)
    all_ranks = sum_over_ranks([seconds])
    seconds = all_ranks(1)
  end function cpu_seconds
end module gfb_refinement
