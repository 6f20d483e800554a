#include "gfb_petsc.h"
!> What a restart file holds: memories, and fields in the order that does not depend on the ranks.
module gfb_restart_fields
  use petscvec
  use gfb_kinds, only: wp
  use gfb_natural_order, only: natural_order_type, contact_order, to_natural, from_natural, vector_values, &
                               set_vector
  use gfb_contact_set, only: contact_set_type
  use gfb_memory, only: memory_type, open_memory
  use gfb_contact_memory, only: pack_contacts, unpack_contacts
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  use gfb_contact_record, only: contact_record_type, record_fields
  implicit none (type)
  private
  public :: put_memory, read_memory, end_memory, put_field, read_field, put_vector, read_vector, put_contacts, read_contacts, &
            put_contact_record, read_contact_record

  character(len=*), parameter :: words_meaning = 'name, kind and shape of the numbers, one a line; texts behind theirs'

contains

  !> Adds what was packed, which is the same on all ranks but for its numbers: the first rank's count.
  subroutine put_memory(memory, group, meaning, file)
    type(memory_type), intent(in) :: memory !! that has packed
    character(len=*), intent(in) :: group   !! of the file, a new one
    character(len=*), intent(in) :: meaning !! of the numbers
    type(result_file_type), intent(inout) :: file !! that is being written

    call file%group(group)
    call file%put_text(group//'/words', memory%words(), words_meaning)
    call file%put_numbers(group//'/numbers', memory%numbers(), 'SI', meaning)
  end subroutine put_memory

  !> Begins to unpack what `put_memory` has added.
  subroutine read_memory(group, file, memory)
    character(len=*), intent(in) :: group !! of the file
    type(stored_file_type), intent(inout) :: file !! that is being read
    type(memory_type), intent(out) :: memory !! that will unpack

    call open_memory(file%numbers(group//'/numbers'), file%words(group//'/words'), memory)
    memory%failed = file%failed
  end subroutine read_memory

  !> Ends unpacking; the file has failed where it does not hold what was looked for.
  subroutine end_memory(memory, file)
    type(memory_type), intent(inout) :: memory !! that has unpacked
    type(stored_file_type), intent(inout) :: file !! that is being read

    call memory%finish()
    file%failed = file%failed .or. memory%failed
  end subroutine end_memory

  !> Adds a field.
  subroutine put_field(order, value, path, unit, meaning, file)
    type(natural_order_type), intent(in) :: order !! of the things
    real(wp), intent(in) :: value(:, :)    !! (components, things this rank owns)
    character(len=*), intent(in) :: path   !! of the field in the file
    character(len=*), intent(in) :: unit   !! of the numbers
    character(len=*), intent(in) :: meaning !! of the numbers
    type(result_file_type), intent(inout) :: file !! that is being written

    if (order%total == 0) return
    call file%put_block(path, to_natural(order, value), order%offset(), order%total, unit, meaning)
  end subroutine put_field

  !> Reads a field; zeros where it cannot be read.
  function read_field(order, components, path, file) result(value)
    type(natural_order_type), intent(in) :: order !! of the things
    integer, intent(in) :: components    !! numbers of each
    character(len=*), intent(in) :: path !! of the field in the file
    type(stored_file_type), intent(inout) :: file !! that is being read
    real(wp) :: value(components, size(order%number))

    value = 0.0_wp
    if (order%total == 0) return
    value = from_natural(order, file%block(path, components, order%offset(), order%entries()))
  end function read_field

  !> Adds a vector.
  subroutine put_vector(order, vector, path, meaning, file)
    type(natural_order_type), intent(in) :: order !! of its unknowns
    Vec, intent(in) :: vector !! scaled unknowns of all ranks
    character(len=*), intent(in) :: path !! of the field in the file
    character(len=*), intent(in) :: meaning !! of the numbers
    type(result_file_type), intent(inout) :: file !! that is being written
    call put_field(order, vector_values(vector), path, '1', meaning, file)
  end subroutine put_vector

  !> Reads a vector.
  subroutine read_vector(order, path, file, vector)
    type(natural_order_type), intent(in) :: order !! of its unknowns
    character(len=*), intent(in) :: path !! of the field in the file
    type(stored_file_type), intent(inout) :: file !! that is being read
    Vec, intent(in) :: vector !! scaled unknowns of all ranks, is filled
    call set_vector(read_field(order, 1, path, file), vector)
  end subroutine read_vector

  !> Adds a column of numbers for each contact.
  subroutine put_columns(order, words, column, group, meaning, file)
    type(natural_order_type), intent(in) :: order !! of the contacts
    character(len=*), intent(in) :: words         !! of a memory: what each column holds
    real(wp), intent(in) :: column(:, :)          !! (numbers, contacts of this rank)
    character(len=*), intent(in) :: group, meaning
    type(result_file_type), intent(inout) :: file

    if (order%total == 0) return
    call file%group(group)
    call file%put_text(group//'/words', words, words_meaning)
    call put_field(order, column, group//'/numbers', 'SI', meaning//'; contact by surface, line and node', file)
  end subroutine put_columns

  !> Reads the columns; zeros where the file has other ones.
  function read_columns(order, words, numbers, group, file) result(column)
    type(natural_order_type), intent(in) :: order !! of the contacts
    character(len=*), intent(in) :: words         !! of a memory: what each column has to hold
    integer, intent(in) :: numbers                !! of a column
    character(len=*), intent(in) :: group
    type(stored_file_type), intent(inout) :: file
    real(wp) :: column(numbers, size(order%number))

    column = 0.0_wp
    if (order%total == 0) return
    if (file%words(group//'/words') /= words) file%failed = .true.
    column = read_field(order, numbers, group//'/numbers', file)
  end function read_columns

  !> Adds what contacts remember.
  subroutine put_contacts(contacts, rows, group, file)
    type(contact_set_type), intent(in) :: contacts !! of this rank
    integer, intent(in) :: rows !! nodes of a line
    character(len=*), intent(in) :: group !! of the file, a new one
    type(result_file_type), intent(inout) :: file !! that is being written
    character(len=:), allocatable :: words
    real(wp), allocatable :: column(:, :)

    call pack_contacts(contacts, words, column)
    call put_columns(contact_order(contacts, rows), words, column, group, 'memory of the contacts', file)
  end subroutine put_contacts

  !> Gives contacts back what they remember.
  subroutine read_contacts(rows, group, file, contacts)
    integer, intent(in) :: rows !! nodes of a line
    character(len=*), intent(in) :: group !! of the file
    type(stored_file_type), intent(inout) :: file !! that is being read
    type(contact_set_type), intent(inout) :: contacts !! of this rank; their memory is filled
    character(len=:), allocatable :: words
    real(wp), allocatable :: column(:, :)

    call pack_contacts(contacts, words, column) ! what the file must have
    column = read_columns(contact_order(contacts, rows), words, size(column, 1), group, file)
    call unpack_contacts(words, column, contacts, file%failed)
  end subroutine read_contacts

  !> Adds the contacts of the steps so far.
  subroutine put_contact_record(contacts, rows, record, steps, group, file)
    type(contact_set_type), intent(in) :: contacts !! that were recorded
    integer, intent(in) :: rows !! nodes of a line
    type(contact_record_type), intent(in) :: record !! of all steps
    integer, intent(in) :: steps !! so far
    character(len=*), intent(in) :: group !! of the file, a new one
    type(result_file_type), intent(inout) :: file !! that is being written
    real(wp), allocatable :: column(:, :)
    integer :: i

    allocate (column(record_fields*steps, size(contacts%point)))
    do i = 1, size(contacts%point)
      column(:, i) = reshape(record%value(:, i, :steps), [size(column, 1)])
    end do
    call put_columns(contact_order(contacts, rows), step_words(steps), column, group, 'contacts step by step', file)
  end subroutine put_contact_record

  !> Reads the contacts of the steps so far.
  subroutine read_contact_record(contacts, rows, steps, group, file, record)
    type(contact_set_type), intent(in) :: contacts !! that were recorded
    integer, intent(in) :: rows  !! nodes of a line
    integer, intent(in) :: steps !! so far
    character(len=*), intent(in) :: group !! of the file
    type(stored_file_type), intent(inout) :: file !! that is being read
    type(contact_record_type), intent(inout) :: record !! is filled
    real(wp), allocatable :: column(:, :)
    integer :: i

    column = read_columns(contact_order(contacts, rows), step_words(steps), record_fields*steps, group, file)
    allocate (record%value(record_fields, size(contacts%point), steps))
    do i = 1, size(contacts%point)
      record%value(:, i, :) = reshape(column(:, i), [record_fields, steps])
    end do
  end subroutine read_contact_record

  !> What a contact's column of steps holds.
  pure function step_words(steps) result(words)
    integer, intent(in) :: steps
    character(len=:), allocatable :: words
    type(memory_type) :: memory
    real(wp) :: value(record_fields, steps)

    value = 0.0_wp
    call memory%visit('force, friction, slip and state', value)
    words = memory%words()
  end function step_words
end module gfb_restart_fields
