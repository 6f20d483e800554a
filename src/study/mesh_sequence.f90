!> What answers on nested meshes say of the error of one number, or of all stiffness and damping.
module gfb_mesh_sequence
  use gfb_kinds, only: wp
  use gfb_grid_convergence, only: convergence_type, estimate_errors, estimate_error
  use gfb_study_cases, only: accuracy_case_type, all_coefficients, asked_name
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: is_nodal, add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_nested_meshes, only: formal_order
  implicit none (type, external)
  private
  public :: start_sequence

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
  type, public :: mesh_sequence_type
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
end module gfb_mesh_sequence
