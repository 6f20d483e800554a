!> What nested meshes say of one number: values, errors, and whether the target is met.
module gfb_mesh_sequence
  use gfb_kinds, only: wp
  use gfb_accuracy_case, only: accuracy_case_type, all_coefficients, asked_name
  use gfb_coefficient_errors, only: entry_errors, worst_error
  use gfb_grid_convergence, only: convergence_type, estimate_error
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: is_nodal
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: start_sequence

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
  contains
    procedure :: add => sequence_add
    procedure :: add_failure => sequence_add_failure
    procedure :: add_coefficients => sequence_add_coefficients
    procedure :: drop_coefficients => sequence_drop_coefficients
    procedure :: coefficient_errors => sequence_coefficient_errors
    procedure :: is_of_many => sequence_is_of_many
    procedure :: met => sequence_met
    procedure :: quantities => sequence_quantities
    procedure :: show => sequence_show
    procedure :: needs => sequence_needs
    procedure :: value_words => sequence_value_words
    procedure, private :: has_error => sequence_has_error
    procedure, private :: last => sequence_last
  end type mesh_sequence_type

contains

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

  !> Takes a mesh's value, and judges all of them.
  subroutine sequence_add(self, mesh, quantity, unknowns, seconds)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    character(len=*), intent(in) :: mesh     !! in words
    type(quantity_type), intent(in) :: quantity !! its number on that mesh
    integer, intent(in) :: unknowns !! of its equations
    real(wp), intent(in) :: seconds          !! CPU time of all ranks [s]
    type(mesh_answer_type) :: one

    self%unit = quantity%unit
    self%value = [self%value, quantity%number]
    one%mesh = mesh
    one%found = .true.
    one%unknowns = unknowns
    one%seconds = seconds
    if (self%is_of_many()) then
      one%estimate = worst_error(self%coefficients, self%formal_order)
    else
      one%estimate = estimate_error(self%value, self%formal_order, self%nodal)
    end if
    self%answer = [self%answer, one]
  end subroutine sequence_add

  !> Takes a mesh's stiffness and damping, before its value.
  pure subroutine sequence_add_coefficients(self, values)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    real(wp), intent(in) :: values(:) !! [SI] as many on every mesh
    real(wp), allocatable :: all(:)

    allocate (all(0))
    if (allocated(self%coefficients)) all = reshape(self%coefficients, [size(self%coefficients)])
    self%coefficients = reshape([all, values], [size(values), size(all)/size(values) + 1])
  end subroutine sequence_add_coefficients

  !> A mesh without an answer: coarser ones' stiffness and damping no longer count.
  pure subroutine sequence_drop_coefficients(self)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    if (allocated(self%coefficients)) deallocate (self%coefficients)
  end subroutine sequence_drop_coefficients

  !> Errors of the finest mesh's stiffness and damping; not allocated where none is known.
  pure subroutine sequence_coefficient_errors(self, errors)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    real(wp), allocatable, intent(out) :: errors(:) !! [SI] in the order of the coefficients

    if (.not. allocated(self%coefficients)) return
    if (size(self%coefficients, 2) < 2) return
    errors = entry_errors(self%coefficients, self%formal_order)
  end subroutine sequence_coefficient_errors

  !> Whether the error is that of all stiffness and damping, relative, and belongs to no value.
  pure function sequence_is_of_many(self) result(is)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    logical :: is
    is = self%name == all_coefficients
  end function sequence_is_of_many

  !> Takes a mesh without an answer: coarser ones no longer count, the next one is none of theirs.
  subroutine sequence_add_failure(self, mesh, unknowns, seconds)
    class(mesh_sequence_type), intent(inout) :: self !! the sequence
    character(len=*), intent(in) :: mesh     !! in words
    integer, intent(in) :: unknowns !! of its equations
    real(wp), intent(in) :: seconds          !! CPU time of all ranks [s]
    type(mesh_answer_type) :: one

    self%value = self%value(:0)
    one%mesh = mesh
    one%unknowns = unknowns
    one%seconds = seconds
    self%answer = [self%answer, one]
  end subroutine sequence_add_failure

  !> The finest mesh's estimate.
  pure function sequence_last(self) result(estimate)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(convergence_type) :: estimate
    if (size(self%value) > 0) estimate = self%answer(size(self%answer))%estimate
  end function sequence_last

  !> Whether the finest mesh's error is known.
  pure function sequence_has_error(self) result(has)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    logical :: has
    has = size(self%value) > 1
  end function sequence_has_error

  !> Whether the finest mesh's error is as small as asked for. Two meshes do not show an order, and
  !> an estimate without one is not enough.
  pure function sequence_met(self) result(met)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    logical :: met
    type(convergence_type) :: last

    last = self%last()
    met = size(self%value) >= least_meshes .and. last%error <= self%target*abs(last%value)
  end function sequence_met

  !> What the summary says of the error.
  function sequence_quantities(self) result(list)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(quantity_type), allocatable :: list(:)
    type(convergence_type) :: last

    if (self%has_error()) then
      last = self%last()
      call add_result(list, self%name//'_error', last%error)
      call add_result(list, self%name//'_order', last%order)
    end if
    call add_result(list, 'accuracy_met', self%met(), self%name)
    call add_result(list, 'meshes', size(self%answer))
  end function sequence_quantities

  !> The meshes as a table.
  subroutine sequence_show(self, log)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    type(run_log_type), intent(in) :: log !! where lines go
    character(len=80) :: line
    integer :: i

    call log%heading('accuracy of '//self%name)
    write (line, row_format) 'elements', 'unknowns', 'value ['//self%unit//']', 'estimate', &
      'order', 'CPU [s]'
    call log%line(trim(line))
    do i = 1, size(self%answer)
      associate (answer => self%answer(i))
        if (answer%found) then
          write (line, row_format) answer%mesh, text(answer%unknowns), &
            shown_value(self, answer%estimate), error_words(answer%estimate), &
            order_words(answer%estimate), text(answer%seconds, 3)
        else
          write (line, row_format) answer%mesh, text(answer%unknowns), 'no answer', '', '', &
            text(answer%seconds, 3)
        end if
      end associate
      call log%line(trim(line))
    end do
  end subroutine sequence_show

  !> A value; none of many.
  pure function shown_value(self, estimate) result(words)
    class(mesh_sequence_type), intent(in) :: self
    type(convergence_type), intent(in) :: estimate
    character(len=:), allocatable :: words

    words = '-'
    if (.not. self%is_of_many()) words = text(estimate%value, 8)
  end function shown_value

  !> An estimate; none on one mesh.
  pure function error_words(estimate) result(words)
    type(convergence_type), intent(in) :: estimate
    character(len=:), allocatable :: words

    words = '-'
    if (estimate%error < huge(1.0_wp)) words = '+- '//text(estimate%error, 3)
  end function error_words

  !> An order; none where it is not believed.
  pure function order_words(estimate) result(words)
    type(convergence_type), intent(in) :: estimate
    character(len=:), allocatable :: words

    words = '-'
    if (estimate%trusted .and. estimate%order > 0.0_wp) words = text(estimate%order, 3)
  end function order_words

  !> The number with its error, in words.
  function sequence_value_words(self) result(words)
    class(mesh_sequence_type), intent(in) :: self !! the sequence
    character(len=:), allocatable :: words
    type(convergence_type) :: last

    last = self%last()
    if (self%is_of_many()) then
      words = 'stiffness and damping: no error yet'
      if (.not. self%has_error()) return
      words = 'stiffness and damping: errors up to '//text(100.0_wp*last%error, 2)// &
              ' % of the largest entry of a block ('//text(last%error, 2)
    else
      words = self%name//' = '//text(last%value, 6)//' '//self%unit
      if (.not. self%has_error()) return
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
