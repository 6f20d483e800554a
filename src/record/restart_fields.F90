#include "gfb_petsc.h"
!> Fields of a restart file, in the order that does not depend on the ranks.
module gfb_restart_fields
  use petscvec
  use gfb_kinds, only: wp
  use gfb_natural_order, only: natural_order_type, contact_order, to_natural, from_natural, vector_values, &
                               set_vector
  use gfb_contact_set, only: contact_set_type
  use gfb_contact_memory, only: memory_size, contact_memory, recall_contacts
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  use gfb_contact_record, only: contact_record_type, record_fields
  implicit none (type)
  private
  public :: put_vector, read_vector, put_contacts, read_contacts, put_contact_record, read_contact_record

contains

  !> Adds a field.
  subroutine put_field(order, value, path, unit, meaning, file)
    type(natural_order_type), intent(in) :: order
    real(wp), intent(in) :: value(:, :) !! (components, things this rank owns)
    character(len=*), intent(in) :: path, unit, meaning
    type(result_file_type), intent(inout) :: file

    if (order%total == 0) return
    call file%put_block(path, to_natural(order, value), order%offset(), order%total, unit, meaning)
  end subroutine put_field

  !> Reads a field; zeros where it cannot be read.
  function read_field(order, components, path, file) result(value)
    type(natural_order_type), intent(in) :: order
    integer, intent(in) :: components
    character(len=*), intent(in) :: path
    type(stored_file_type), intent(inout) :: file
    real(wp) :: value(components, size(order%number))

    value = 0.0_wp
    if (order%total == 0) return
    value = from_natural(order, file%block(path, components, order%offset(), order%entries()))
  end function read_field

  !> Adds a vector.
  subroutine put_vector(order, vector, path, meaning, file)
    type(natural_order_type), intent(in) :: order
    Vec, intent(in) :: vector
    character(len=*), intent(in) :: path, meaning
    type(result_file_type), intent(inout) :: file
    call put_field(order, vector_values(vector), path, '1', meaning, file)
  end subroutine put_vector

  !> Reads a vector.
  subroutine read_vector(order, path, file, vector)
    type(natural_order_type), intent(in) :: order
    character(len=*), intent(in) :: path
    type(stored_file_type), intent(inout) :: file
    Vec, intent(in) :: vector
    call set_vector(read_field(order, 1, path, file), vector)
  end subroutine read_vector

  !> Adds what contacts remember.
  subroutine put_contacts(contacts, rows, path, file)
    type(contact_set_type), intent(in) :: contacts
    integer, intent(in) :: rows !! nodes of a line
    character(len=*), intent(in) :: path
    type(result_file_type), intent(inout) :: file

    call put_field(contact_order(contacts, rows), contact_memory(contacts), path, 'SI', &
                   'slip origins, slip and friction at the last commit, places, anchors, forces, '// &
                   'derivatives; contact by surface, line and node', file)
  end subroutine put_contacts

  !> Gives contacts back what they remember.
  subroutine read_contacts(rows, path, file, contacts)
    integer, intent(in) :: rows
    character(len=*), intent(in) :: path
    type(stored_file_type), intent(inout) :: file
    type(contact_set_type), intent(inout) :: contacts
    call recall_contacts(read_field(contact_order(contacts, rows), memory_size, path, file), contacts)
  end subroutine read_contacts

  !> Adds the contacts of the steps so far.
  subroutine put_contact_record(contacts, rows, record, steps, path, file)
    type(contact_set_type), intent(in) :: contacts
    integer, intent(in) :: rows
    type(contact_record_type), intent(in) :: record
    integer, intent(in) :: steps !! so far
    character(len=*), intent(in) :: path
    type(result_file_type), intent(inout) :: file
    real(wp), allocatable :: value(:, :)
    integer :: step

    allocate (value(record_fields*steps, size(contacts%point)))
    do step = 1, steps
      value((step - 1)*record_fields + 1:step*record_fields, :) = record%value(:, :, step)
    end do
    call put_field(contact_order(contacts, rows), value, path, 'SI', &
                   'force, friction, slip and state, step by step; contact by surface, line and node', file)
  end subroutine put_contact_record

  !> Reads the contacts of the steps so far.
  subroutine read_contact_record(contacts, rows, steps, path, file, record)
    type(contact_set_type), intent(in) :: contacts
    integer, intent(in) :: rows
    integer, intent(in) :: steps
    character(len=*), intent(in) :: path
    type(stored_file_type), intent(inout) :: file
    type(contact_record_type), intent(inout) :: record
    real(wp), allocatable :: value(:, :)
    integer :: step

    value = read_field(contact_order(contacts, rows), record_fields*steps, path, file)
    allocate (record%value(record_fields, size(contacts%point), steps))
    do step = 1, steps
      record%value(:, :, step) = value((step - 1)*record_fields + 1:step*record_fields, :)
    end do
  end subroutine read_contact_record
end module gfb_restart_fields
