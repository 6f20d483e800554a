!> A study on nested meshes, until the error of one number is as small as asked for.
module gfb_refinement
  use gfb_kinds, only: wp
  use gfb_grid_convergence, only: convergence_type, estimate_errors, estimate_error
  use gfb_study_cases, only: accuracy_case_type, all_coefficients, asked_name
  use gfb_quantity, only: quantity_type, place_of
  use gfb_result_names, only: is_nodal, add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_errors, only: error_type
  use gfb_foil_row, only: foil_beam
  use gfb_model_case, only: film_order_bilinear, film_order_biquadratic, &
                            film_scheme_auto, film_scheme_galerkin, film_scheme_supg
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_reasons, only: reason_inaccurate
  use gfb_run_context, only: run_context_type
  use gfb_signals, only: stop_agreed
  use gfb_scene, only: scene_type
  use gfb_scene_rules, only: is_symmetric
  use gfb_study, only: study_type
  use gfb_bearing_case, only: pad_length
  use gfb_mesh_case, only: mesh_case_type
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_plan, only: plan_bearing
  implicit none (type, external)
  private
  public :: nested_mesh, mesh_words, formal_order, keep_scheme

  integer, parameter :: quarter = 4             !! the first mesh is coarser by it in each direction
  integer, parameter :: least_circumferential = 4

  integer, parameter :: rotations = 2 !! the last of the motions
  !> Each way: displacements, 2 of a journal and 1 of a runner, and rotations.
  integer, parameter :: blocks = 2
  real(wp), parameter :: vanishing = 1.0e-9_wp !! a coupling block below that of its neighbours [1]

  integer, parameter :: least_meshes = 3 !! that show an order
  character(len=*), parameter :: row_format = '(a16,a11,a18,a14,a7,a10)'

  !> A mesh and its answer.
  type :: mesh_answer_type
    character(len=:), allocatable :: mesh  !! in words
    logical :: found = .false.             !! it has an answer
    integer :: unknowns = 0
    real(wp) :: seconds = 0.0_wp           !! CPU time of all ranks [s]
    type(convergence_type) :: estimate     !! with this mesh as the finest
  end type mesh_answer_type

  !> The meshes so far.
  type :: mesh_sequence_type
    character(len=:), allocatable :: name  !! of the number
    character(len=:), allocatable :: unit  !! its unit
    real(wp) :: target = 0.0_wp            !! error allowed, relative
    real(wp) :: formal_order = 0.0_wp      !! of the elements [1]
    logical :: nodal = .false.             !! the number is the largest or smallest at the nodes
    type(mesh_answer_type), allocatable :: answer(:)
    real(wp), allocatable :: value(:)      !! of the meshes in a row that have answers
    real(wp), allocatable :: coefficients(:, :) !! (entry, mesh) the same of stiffness, damping [SI]
    integer :: matrices = 0 !! of stiffness and damping
  contains
    procedure :: add => sequence_add, add_coefficients => sequence_add_coefficients
    procedure :: coefficient_errors => sequence_coefficient_errors
    procedure :: is_of_many => sequence_is_of_many, met => sequence_met
    procedure :: quantities => sequence_quantities, show => sequence_show, needs => sequence_needs
    procedure :: value_words => sequence_value_words
    procedure, private :: last => sequence_last
  end type mesh_sequence_type

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

  !> What the meshes say of every entry; those of a block share one order.
  !>
  !> Blocks of each matrix: force over displacement, force over rotation, ...
  pure function entry_estimates(value, formal_order, matrices) result(estimate)
    real(wp), intent(in) :: value(:, :) !! [SI] (entry, mesh), square matrices behind each other
    real(wp), intent(in) :: formal_order !! of the elements [1]
    integer, intent(in) :: matrices !! their number
    type(convergence_type), allocatable :: estimate(:)
    integer, allocatable :: entry(:)
    integer :: i, j, k

    allocate (estimate(size(value, 1)))
    do k = 0, matrices - 1
      do j = 1, blocks
        do i = 1, blocks
          entry = k*(size(value, 1)/matrices) + entries_of_block(size(value, 1)/matrices, i, j)
          estimate(entry) = estimate_errors(value(entry, :), formal_order)
        end do
      end do
    end do
  end function entry_estimates

  !> Numbers of a block's entries in a matrix.
  pure function entries_of_block(entries, i, j) result(number)
    integer, intent(in) :: entries !! of the matrix, which is square
    integer, intent(in) :: i, j !! block of rows, of columns
    integer, allocatable :: number(:)
    integer :: motions, row, column

    motions = nint(sqrt(real(entries, wp)))
    associate (last => [motions - rotations, motions])
      number = [((motions*(column - 1) + row, row=merge(1, last(1) + 1, i == 1), last(i)), &
                 column=merge(1, last(1) + 1, j == 1), last(j))]
    end associate
  end function entries_of_block

  !> The largest error of an entry over the largest entry of its block, with that entry's order.
  pure function worst_error(value, formal_order, matrices) result(worst)
    real(wp), intent(in) :: value(:, :) !! [SI] (entry, mesh), square matrices behind each other
    real(wp), intent(in) :: formal_order !! of the elements [1]
    integer, intent(in) :: matrices !! their number
    type(convergence_type) :: worst !! its value is 1, so that its error is relative
    type(convergence_type), allocatable :: estimate(:)
    real(wp), allocatable :: scale(:)
    integer :: i

    worst%value = 1.0_wp
    if (size(value, 2) < 2) return
    worst%error = 0.0_wp
    worst%trusted = .true.
    scale = block_sizes(value(:, size(value, 2)), matrices)
    estimate = entry_estimates(value, formal_order, matrices)
    do i = 1, size(scale)
      if (.not. scale(i) > 0.0_wp) cycle
      if (.not. estimate(i)%error/scale(i) > worst%error) cycle
      worst%error = estimate(i)%error/scale(i)
      worst%order = estimate(i)%order
      worst%trusted = estimate(i)%trusted
    end do
  end function worst_error

  !> Largest entry of the block that each entry belongs to; 0 where the block vanishes.
  pure function block_sizes(value, matrices) result(sizes)
    real(wp), intent(in) :: value(:) !! [SI] square matrices behind each other
    integer, intent(in) :: matrices !! their number
    real(wp), allocatable :: sizes(:) !! [SI]
    real(wp) :: largest(blocks, blocks)
    integer :: i, j, k

    allocate (sizes(size(value)))
    associate (entries => size(value)/matrices)
      do k = 0, matrices - 1
        do j = 1, blocks
          do i = 1, blocks
            largest(i, j) = maxval(abs(value(k*entries + entries_of_block(entries, i, j))))
          end do
        end do
        where (largest <= vanishing*sqrt(largest(1, 1)*largest(2, 2))) largest = 0.0_wp
        do j = 1, blocks
          do i = 1, blocks
            sizes(k*entries + entries_of_block(entries, i, j)) = largest(i, j)
          end do
        end do
      end do
    end associate
  end function block_sizes

  !> A sequence without meshes.
  pure function start_sequence(accuracy, formal_order) result(sequence)
    type(accuracy_case_type), intent(in) :: accuracy !! what is asked for
    real(wp), intent(in) :: formal_order !! of the elements [1]
    type(mesh_sequence_type) :: sequence

    sequence%name = asked_name(accuracy)
    sequence%unit = ''
    sequence%target = accuracy%target
    sequence%formal_order = formal_order
    sequence%nodal = is_nodal(sequence%name)
    allocate (sequence%answer(0), sequence%value(0))
  end function start_sequence

  !> Takes a mesh, and judges the values of all of them. Without a value coarser ones no longer
  !> count: the next one is none of theirs.
  subroutine sequence_add(self, mesh, unknowns, seconds, quantity)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    character(len=*), intent(in) :: mesh     !! in words
    integer, intent(in) :: unknowns !! of its equations
    real(wp), intent(in) :: seconds          !! CPU time of all ranks [s]
    type(quantity_type), intent(in), optional :: quantity !! its number on that mesh
    type(mesh_answer_type) :: one

    one%mesh = mesh
    one%found = present(quantity)
    one%unknowns = unknowns
    one%seconds = seconds
    if (.not. one%found) then
      self%value = self%value(:0)
    else
      self%unit = quantity%unit
      self%value = [self%value, quantity%number]
      if (self%is_of_many()) then
        one%estimate = worst_error(self%coefficients, self%formal_order, self%matrices)
      else
        one%estimate = estimate_error(self%value, self%formal_order, self%nodal)
      end if
    end if
    self%answer = [self%answer, one]
  end subroutine sequence_add

  !> Takes a mesh's stiffness and damping, before its value.
  pure subroutine sequence_add_coefficients(self, values, matrices)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    real(wp), intent(in) :: values(:) !! [SI] as many on every mesh
    integer, intent(in) :: matrices !! that they are of
    real(wp), allocatable :: all(:)

    self%matrices = matrices
    allocate (all(0))
    if (allocated(self%coefficients)) all = reshape(self%coefficients, [size(self%coefficients)])
    self%coefficients = reshape([all, values], [size(values), size(all)/size(values) + 1])
  end subroutine sequence_add_coefficients

  !> Errors of the finest mesh's stiffness and damping; not allocated where none is known.
  pure subroutine sequence_coefficient_errors(self, errors)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    real(wp), allocatable, intent(out) :: errors(:) !! [SI] in the order of the coefficients
    type(convergence_type), allocatable :: estimate(:)

    if (.not. allocated(self%coefficients)) return
    if (size(self%coefficients, 2) < 2) return
    estimate = entry_estimates(self%coefficients, self%formal_order, self%matrices)
    errors = estimate%error
  end subroutine sequence_coefficient_errors

  !> Whether the error is that of all stiffness and damping, relative, and belongs to no value.
  pure logical function sequence_is_of_many(self) result(is)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    is = self%name == all_coefficients
  end function sequence_is_of_many

  !> The finest mesh's estimate.
  pure function sequence_last(self) result(estimate)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(convergence_type) :: estimate
    if (size(self%value) > 0) estimate = self%answer(size(self%answer))%estimate
  end function sequence_last

  !> Whether the finest mesh's error is as small as asked for. Two meshes do not show an order, and
  !> an estimate without one is not enough.
  pure logical function sequence_met(self) result(met)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(convergence_type) :: last

    last = self%last()
    met = size(self%value) >= least_meshes .and. last%error <= self%target*abs(last%value)
  end function sequence_met

  !> What the summary says of the error.
  function sequence_quantities(self) result(list)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(quantity_type), allocatable :: list(:)
    type(convergence_type) :: last

    if (size(self%value) > 1) then
      last = self%last()
      call add_result(list, self%name//'_error', last%error)
      call add_result(list, self%name//'_order', last%order)
    end if
    call add_result(list, 'accuracy_met', self%met(), self%name)
    call add_result(list, 'meshes', size(self%answer))
  end function sequence_quantities

  !> The meshes as a table; a dash where there is no value, error, or order that is believed.
  subroutine sequence_show(self, log)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(run_log_type), intent(in) :: log !! where lines go
    character(len=:), allocatable :: value, error, order
    character(len=80) :: line
    integer :: i

    call log%heading('accuracy of '//self%name)
    write (line, row_format) 'elements', 'unknowns', 'value ['//self%unit//']', 'estimate', &
      'order', 'CPU [s]'
    call log%line(trim(line))
    do i = 1, size(self%answer)
      associate (answer => self%answer(i), estimate => self%answer(i)%estimate)
        value = 'no answer'
        error = ''
        order = ''
        if (answer%found) then
          value = '-'
          error = '-'
          order = '-'
          if (.not. self%is_of_many()) value = text(estimate%value, 8)
          if (estimate%error < huge(1.0_wp)) error = '+- '//text(estimate%error, 3)
          if (estimate%trusted .and. estimate%order > 0.0_wp) order = text(estimate%order, 3)
        end if
        write (line, row_format) answer%mesh, text(answer%unknowns), value, error, order, &
          text(answer%seconds, 3)
      end associate
      call log%line(trim(line))
    end do
  end subroutine sequence_show

  !> The number with its error, in words.
  function sequence_value_words(self) result(words)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    character(len=:), allocatable :: words
    type(convergence_type) :: last

    last = self%last()
    if (self%is_of_many()) then
      words = 'stiffness and damping: no error yet'
      if (size(self%value) < 2) return
      words = 'stiffness and damping: errors up to '//text(100.0_wp*last%error, 2)// &
              ' % of the largest entry of a block ('//text(last%error, 2)
    else
      words = self%name//' = '//text(last%value, 6)//' '//self%unit
      if (size(self%value) < 2) return
      words = self%name//' = '//text(last%value, 6)//' +- '//text(last%error, 2)//' '//self%unit
    end if
    if (self%is_of_many()) then
      words = words//' relative'
    else if (abs(last%value) > 0.0_wp) then
      words = words//' ('//text(100.0_wp*last%error/abs(last%value), 2)//' %'
    else
      words = words//' (a value of zero has no relative error'
    end if
    if (last%trusted .and. last%order > 0.0_wp) then
      words = words//', observed order '//text(last%order, 3)//')'
    else if (last%trusted) then
      words = words//', finer meshes change nothing)'
    else
      words = words//', no order observed)'
    end if
  end function sequence_value_words

  !> What a target that is not met would need, in words.
  function sequence_needs(self) result(words)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    character(len=:), allocatable :: words
    type(convergence_type) :: last
    real(wp) :: order, ratio

    last = self%last()
    if (size(self%value) < least_meshes) then
      words = 'answers on '//text(least_meshes)//' meshes at least'
    else if (.not. abs(last%value) > 0.0_wp) then
      words = 'another quantity: a relative target has no meaning for zero'
    else if (.not. last%trusted) then
      words = 'finer meshes, on which the values approach a limit'
    else
      order = max(min(last%order, self%formal_order), tiny(1.0_wp))
      ratio = last%error/(self%target*abs(last%value))
      words = 'about '//text(ceiling(log(ratio)/(order*log(2.0_wp))))// &
              ' more refinement(s), if the order stays'
    end if
  end function sequence_needs

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

  !> Elements of a nested mesh. Number 0 is a quarter of what `&mesh` says, or the coarsest mesh
  !> that a case may have.
  pure function nested_mesh(scene, number) result(mesh)
    type(scene_type), intent(in) :: scene !! on the mesh of its case
    integer, intent(in) :: number !! from 0
    type(mesh_case_type) :: mesh

    mesh = scene%mesh
    mesh%circumferential_elements = first_circumferential(scene)*2**number
    mesh%axial_elements = even_quarter(mesh%axial_elements)*2**number
    mesh%arc_elements = even_quarter(mesh%arc_elements)*2**number
    mesh%flat_elements = max(1, nint(real(mesh%flat_elements, wp)/quarter))*2**number
  end function nested_mesh

  !> Elements along the pad of the first mesh; whole ones a pitch where nodes lie above the
  !> crests, so that doubled numbers divide every pitch by two.
  pure integer function first_circumferential(scene) result(elements)
    type(scene_type), intent(in) :: scene
    real(wp) :: pitches

    elements = max(least_circumferential, &
                   nint(real(scene%mesh%circumferential_elements, wp)/quarter))
    if (.not. (scene%model%foil%has_bumps .and. scene%mesh%align_crests)) return
    pitches = pad_length(scene%bearing)/scene%bump_foil%pitch%value
    elements = max(least_circumferential, nint(pitches*max(1, nint(elements/pitches))))
  end function first_circumferential

  !> A quarter of a number, as an even one.
  elemental integer function even_quarter(number) result(even)
    integer, intent(in) :: number
    even = 2*max(1, nint(real(number, wp)/(2*quarter)))
  end function even_quarter

  !> A mesh in words: elements along the pad and over the width, or of a bump.
  pure function mesh_words(scene) result(words)
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    associate (mesh => scene%mesh)
      words = text(mesh%circumferential_elements)//' x '//text(mesh%axial_elements)
      if (scene%general%analysis%has_film .and. .not. scene%model%foil%has_bumps) return
      words = words//', '//text(mesh%arc_elements)//'+'//text(mesh%flat_elements)
      if (scene%general%analysis%has_film) return
      words = text(mesh%arc_elements)//'+'//text(mesh%flat_elements)//' x '// &
              text(mesh%axial_elements)
    end associate
  end function mesh_words

  !> Order with which the elements of a scene converge.
  pure function formal_order(scene) result(order)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp) :: order !! [1]

    order = 2.0_wp
    associate (model => scene%model)
      if (model%film_order == film_order_biquadratic .and. &
          .not. model%foil%has_top_foil) order = 3.0_wp
    end associate
  end function formal_order

  !> Takes for all meshes the film's weighting that the mesh of the case would have: values of two
  !> schemes approach their limit differently.
  subroutine keep_scheme(scene)
    type(scene_type), intent(inout) :: scene !! of a bearing, on the mesh of the case
    type(bearing_plan_type) :: plan
    type(run_log_type) :: quiet

    if (scene%model%film_scheme /= film_scheme_auto .or. &
        scene%model%film_order /= film_order_bilinear) return
    quiet%active = .false.
    call plan_bearing(scene, quiet, plan)
    scene%model%film_scheme = merge(film_scheme_supg, film_scheme_galerkin, plan%upwind)
  end subroutine keep_scheme
end module gfb_refinement
