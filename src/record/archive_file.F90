!> Archives in a file: a group each, with words, numbers, and a dataset for each field.
module gfb_archive_file
  use gfb_archive, only: archive_type, archive_field_type, open_archive
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type
  use gfb_division, only: block_ends
  implicit none (type, external)
  private
  public :: write_archive, read_archive

contains

  !> Adds an archive to a file, in a group of its name: words, numbers, and a dataset for each field. Numbers and
  !> words are those of the first rank; of a field each rank writes and reads its block.
  subroutine write_archive(archive, file)
    type(archive_type), intent(in) :: archive !! that has saved
    type(result_file_type), intent(inout) :: file !! that is being written
    character(len=:), allocatable :: group, fields
    integer :: i

    group = '/'//archive%name
    fields = ''
    call file%group(group)
    call file%put_text(group//'/words', archive%words(), &
                       'name, kind and shape of the numbers, one a line; texts behind theirs')
    call file%put_numbers(group//'/numbers', archive%numbers(), 'SI', 'in the order of the words')
    if (allocated(archive%field)) then
      do i = 1, size(archive%field)
        associate (field => archive%field(i))
          fields = fields//field%name//new_line('a')
          call file%put_block(group//'/'//field%name, field%block, field%offset, field%total, &
                              'SI', 'in an order that does not depend on the ranks; states scaled')
        end associate
      end do
    end if
    if (fields == '') return
    call file%put_text(group//'/fields', fields, 'names of the fields, one a line')
  end subroutine write_archive

  !> Reads one; what cannot be read leaves `failed` behind in the file, and a name there.
  subroutine read_archive(name, rank, ranks, file, archive)
    character(len=*), intent(in) :: name !! of the archive
    !> this one, from 0, and their number: each gets an equal block of each field
    integer, intent(in) :: rank, ranks
    type(stored_file_type), intent(inout) :: file !! that is being read
    type(archive_type), intent(out) :: archive !! will restore
    character(len=:), allocatable :: group, fields
    type(archive_field_type) :: field
    integer :: at, components, ends(2)

    group = '/'//name
    call open_archive(file%numbers(group//'/numbers'), file%words(group//'/words'), archive, judged=.true.)
    archive%name = name
    allocate (archive%field(0))
    fields = ''
    if (file%has(group//'/fields')) fields = file%words(group//'/fields')
    do while (len(fields) > 0)
      at = index(fields//new_line('a'), new_line('a'))
      field%name = fields(:at - 1)
      fields = fields(min(at + 1, len(fields) + 1):)
      call file%find_shape(group//'/'//field%name, components, field%total)
      ends = block_ends(field%total, ranks, rank + 1)
      field%offset = ends(1) - 1
      field%block = file%block(group//'/'//field%name, components, field%offset, &
                               ends(2) - ends(1) + 1)
      archive%field = [archive%field, field]
    end do
  end subroutine read_archive
end module gfb_archive_file
