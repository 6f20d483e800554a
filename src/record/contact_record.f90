!> The contacts of a foil, step by step, for `/contact` of the result file.
module gfb_contact_record
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: visit_field
  use gfb_petsc_session, only: fetch_entries, largest_number
  use gfb_case_file, only: case_array_type, add_array
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top, normal_line_force
  use gfb_contact_memory, only: contact_order
  use gfb_bearing_system, only: bearing_system_type
  use gfb_pad_contacts, only: pad_contacts
  implicit none (type, external)
  private
  public :: record_contacts, add_contact_arrays, record_foil_contacts, add_foil_contacts, &
            visit_contact_record

  !> of a contact: force and friction along x and z, slip, state
  integer, parameter, public :: fields = 6

  !> Contacts of this rank at every step.
  type, public :: contact_record_type
    real(wp), allocatable :: value(:, :, :) !! (fields, contacts of this rank, steps)
  end type contact_record_type

contains

  !> Keeps the contacts of all pads' foils at a point; nothing where it has none.
  subroutine record_foil_contacts(bearing, point, points, record)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in) :: point  !! number of this one
    integer, intent(in) :: points !! that there will be, as far as is known
    type(contact_record_type), intent(inout) :: record !! gets the point
    if (.not. bearing%has_contacts()) return
    call record_contacts(pad_contacts(bearing), point, points, record)
  end subroutine record_foil_contacts

  !> Adds the contacts of all pads' foils at all points; none where they have none.
  subroutine add_foil_contacts(bearing, record, points, arrays)
    type(bearing_system_type), intent(in) :: bearing !! whose contacts were recorded
    type(contact_record_type), intent(in) :: record !! of all points
    integer, intent(in) :: points !! recorded
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    type(foil_surface_type), allocatable :: surface(:)
    integer :: i

    surface = bearing%foil_surfaces()
    do i = 1, size(surface)
      if (.not. surface(i)%has_contacts) cycle
      call add_contact_arrays(pad_contacts(bearing), surface(i), record, points, arrays)
    end do
  end subroutine add_foil_contacts

  !> Adds the present step.
  subroutine record_contacts(contacts, step, steps, record)
    type(contact_set_type), intent(in) :: contacts !! at the step's state, each of one node
    integer, intent(in) :: step  !! number of this one
    integer, intent(in) :: steps !! that there will be, as far as is known
    type(contact_record_type), intent(inout) :: record !! gets the step
    integer :: i

    if (.not. allocated(record%value)) then
      allocate (record%value(fields, size(contacts%point), steps), source=0.0_wp)
    end if
    if (step > size(record%value, 3)) call make_room(2*step, record%value)
    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        record%value(:, i, step) = [normal_line_force(contacts, i), point%force(:2)/point%length, &
                                    point%place(:2), real(contacts%state_of(i), wp)]
      end associate
    end do
  end subroutine record_contacts

  !> Makes room for more steps.
  pure subroutine make_room(steps, value)
    integer, intent(in) :: steps
    real(wp), allocatable, intent(inout) :: value(:, :, :)
    real(wp), allocatable :: longer(:, :, :)

    allocate (longer(size(value, 1), size(value, 2), steps), source=0.0_wp)
    longer(:, :, :size(value, 3)) = value
    call move_alloc(longer, value)
  end subroutine make_room

  !> Saves or restores the contacts of the steps so far, a column of numbers each. All ranks ask.
  subroutine visit_contact_record(archive, contacts, rows, steps, record)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(contact_set_type), intent(in) :: contacts !! that were recorded
    integer, intent(in) :: rows  !! nodes of a line
    integer, intent(in) :: steps !! so far
    !> of all steps; filled where the archive restores
    type(contact_record_type), intent(inout) :: record
    real(wp), allocatable :: column(:, :)
    integer :: i

    if (.not. archive%saves) then
      allocate (record%value(fields, size(contacts%point), steps), source=0.0_wp)
    end if
    allocate (column(fields*steps, size(contacts%point)))
    do i = 1, size(contacts%point)
      column(:, i) = reshape(record%value(:, i, :steps), [size(column, 1)])
    end do
    call visit_field(archive, 'contacts_by_step', contact_order(contacts, rows), column)
    do i = 1, size(contacts%point)
      record%value(:, i, :steps) = reshape(column(:, i), [fields, steps])
    end do
  end subroutine visit_contact_record

  !> Adds everything about the contacts, on the first rank's behalf.
  subroutine add_contact_arrays(contacts, slaves, record, steps, arrays)
    type(contact_set_type), intent(in) :: contacts !! that were recorded, each of one node
    class(foil_surface_type), intent(in) :: slaves !! the surface they are nodes of
    type(contact_record_type), intent(in) :: record !! of all steps
    integer, intent(in) :: steps !! recorded
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file

    if (.not. allocated(record%value)) return
    call add_surface(contacts, slaves, record, steps, contact_sleeve, '/contact/sleeve', arrays)
    call add_surface(contacts, slaves, record, steps, contact_top, '/contact/top', arrays)
  end subroutine add_contact_arrays

  !> Adds the arrays of a surface that has contacts, the whole width also where one half was solved;
  !> a column a node, a row a step.
  subroutine add_surface(contacts, slaves, record, steps, surface, group, arrays)
    type(contact_set_type), intent(in) :: contacts
    class(foil_surface_type), intent(in) :: slaves
    type(contact_record_type), intent(in) :: record
    integer, intent(in) :: steps
    integer, intent(in) :: surface !! `contact_sleeve` or `contact_top`
    character(len=*), intent(in) :: group
    type(case_array_type), allocatable, intent(inout) :: arrays(:)

    character(len=*), parameter :: name(fields) = [character(len=12) :: &
      'normal_force', 'friction_x', 'friction_z', 'slip_x', 'slip_z', 'state']
    character(len=*), parameter :: unit(fields) = [character(len=3) :: &
      'N/m', 'N/m', 'N/m', 'm', 'm', '1']
    character(len=*), parameter :: meaning(fields) = [character(len=64) :: &
      'pressing the foil, per length of contact line; step by node', &
      'on the foil, along the motion, per length of contact line', &
      'on the foil, along the axis, per length of contact line', &
      'slip that the friction law sees, along the motion', &
      'slip that the friction law sees, along the axis', '0 open, 1 sticks, 2 slips']
    real(wp), allocatable :: position(:, :), values(:, :)
    !> the field has the other sign in the half that was not solved
    logical, parameter :: odd(fields) = [.false., .false., .true., .false., .true., .false.]
    integer, allocatable :: number(:), own(:), all_nodes(:)
    logical, allocatable :: mirrored(:)
    integer :: i, total, field

    associate (point => contacts%point, mesh => slaves%mesh)
      own = pack([(i, i=1, size(point))], point%law == surface)
      number = (point(own)%line - 1)*mesh%rows + modulo(point(own)%node - 1, mesh%rows) + 1
      total = largest_number(pack(point%line, point%law == surface))*mesh%rows
      call whole_width(total/mesh%rows, mesh%rows, mesh%half, all_nodes, mirrored)
      allocate (position(3, size(own)))
      position(1, :) = real(point(own)%line, wp)
      position(2:3, :) = mesh%position([1, 3], point(own)%node)
      if (mesh%ring_radius > 0.0_wp) position(2, :) = position(2, :)*position(3, :)/mesh%ring_radius
    end associate
    if (total == 0) return
    values = fetch_entries(total, number, position, all_nodes)
    where (mirrored) values(3, :) = 0.0_wp - values(3, :) ! no minus zero
    call add_array(arrays, group//'/line', '1', 'number of the contact line', values(1:1, :))
    call add_array(arrays, group//'/position_x', 'm', 'of the node, along the motion', &
                   values(2:2, :))
    call add_array(arrays, group//'/position_z', 'm', 'of the node, along the axis', values(3:3, :))
    do field = 1, fields
      values = fetch_entries(total, number, &
                             transpose(record%value(field, own, :steps)), all_nodes)
      do i = 1, size(mirrored)
        if (mirrored(i) .and. odd(field)) values(:, i) = 0.0_wp - values(:, i)
      end do
      values = transpose(values)
      call add_array(arrays, group//'/'//trim(name(field)), trim(unit(field)), &
                     trim(meaning(field)), values, by_step=.true.)
    end do
  end subroutine add_surface

  !> The nodes of all contact lines from end to end of the foil, and which of them stand for their
  !> mirror images at z < 0.
  pure subroutine whole_width(lines, rows, half, node, mirrored)
    integer, intent(in) :: lines, rows !! contact lines; nodes of each that were solved
    logical, intent(in) :: half !! they are those of z >= 0
    integer, allocatable, intent(out) :: node(:) !! number among those that were solved
    logical, allocatable, intent(out) :: mirrored(:)
    integer, allocatable :: across(:)
    integer :: i, k

    across = [(k, k=1, rows)]
    if (half) across = [(k, k=rows, 2, -1), across]
    node = [((i*rows + across(k), k=1, size(across)), i=0, lines - 1)]
    mirrored = [((half .and. k < rows, k=1, size(across)), i=0, lines - 1)]
  end subroutine whole_width
end module gfb_contact_record
